#include "lab/render/context.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/render/platform.hpp"

namespace gobo {

Result<SharedLibrary> SharedLibrary::open(const std::vector<const char*>& file_names,
                                          const std::string& help) {
    SharedLibrary library;
    for (const char* name : file_names) {
        library.handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
        if (library.handle_ != nullptr) return library;
    }
    return fail(Fault::file, fmt::format("cannot load the shared library {}", file_names.front()), help);
}

void* SharedLibrary::address(const char* name) const {
    return dlsym(handle_, name);
}

std::string_view name_of(Backend backend) {
    return backend == Backend::osmesa ? "osmesa" : "egl";
}

Result<Backend> backend_of(std::string_view name) {
    for (const Backend backend : {Backend::osmesa, Backend::egl})
        if (name == name_of(backend)) return backend;
    return fail(Fault::usage, fmt::format("unknown backend '{}'", name), suggestion(name, {"osmesa", "egl"}));
}

// Making a context current a second time cannot fail: open_context() has shown that it can be done.
void Context::make_current() const {
    static_cast<void>(state_->platform->make_current());
}

Result<Context> open_context(Backend backend, int version) {
    auto state = std::make_shared<Context::State>();
    const int major = version / 10;
    const int minor = version % 10;
    auto platform = backend == Backend::osmesa ? open_osmesa(major, minor) : open_egl(major, minor);
    if (!platform) return tl::unexpected(std::move(platform.error()));
    state->backend = backend;
    state->platform = std::move(*platform);
    if (!state->platform->make_current())
        return fail(Fault::file, fmt::format("the {} context cannot be made current", name_of(backend)));
    const auto load = [](void* from, const char* name) {
        return static_cast<const Platform*>(from)->function(name);
    };
    GladGLContext& gl = state->functions;
    const int loaded = gladLoadGLContextUserPtr(&gl, load, state->platform.get());
    state->version = 10 * GLAD_VERSION_MAJOR(loaded) + GLAD_VERSION_MINOR(loaded);
    if (state->version < version)
        return fail(Fault::file, fmt::format("the {} context offers no OpenGL {}.{} core profile",
                                             name_of(backend), major, minor));
    state->renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    return Context(std::move(state));
}

}  // namespace gobo
