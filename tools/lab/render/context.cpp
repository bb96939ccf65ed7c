#include "lab/render/context.hpp"

#include <array>
#include <functional>

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {

/// An OpenGL context of one windowing library.
struct Platform {
    using Function = void (*)();

    Function (*function)(const char* name) = nullptr;  ///< of OpenGL; null where there is none of that name
    std::function<bool()> make_current;
    std::function<void()> destroy;
};

namespace {

/// Opens a shared library by the first of its names that is there. It stays loaded to the end of the process:
/// Mesa and LLVM keep thread-local state that does not survive unloading.
Result<void*> open_library(const std::vector<const char*>& file_names, const char* help) {
    for (const char* name : file_names)
        if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) return library;
    return fail(Fault::file, fmt::format("cannot load the shared library {}", file_names.front()), help);
}

template <class Pointer>
void load(void* library, const char* name, Pointer& function) {
    function = reinterpret_cast<Pointer>(dlsym(library, name));
}

/// OSMesa: Mesa's renderer in the calling process, without a display of any kind.
Result<Platform> open_osmesa(int major, int minor) {
    // From Mesa's GL/osmesa.h, whose package need not be installed to build gobo.
    constexpr int kFormat = 0x22;
    constexpr int kRgba = 0x1908;
    constexpr int kDepthBits = 0x30;
    constexpr int kProfile = 0x33;
    constexpr int kCoreProfile = 0x34;
    constexpr int kMajorVersion = 0x36;
    constexpr int kMinorVersion = 0x37;
    constexpr unsigned kUnsignedByte = 0x1401;
    constexpr const char* kHelp = "install it: apt-get install libosmesa6, or use --backend egl";
    void* (*create)(const int*, void*) = nullptr;
    void (*destroy)(void*) = nullptr;
    unsigned char (*make_current)(void*, void*, unsigned, int, int) = nullptr;
    Platform platform;
    GOBO_TRY(void* library, open_library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, kHelp));
    load(library, "OSMesaCreateContextAttribs", create);
    load(library, "OSMesaDestroyContext", destroy);
    load(library, "OSMesaMakeCurrent", make_current);
    load(library, "OSMesaGetProcAddress", platform.function);
    if (create == nullptr)
        return fail(Fault::file, "this OSMesa is older than 12.0 and has no OSMesaCreateContextAttribs",
                    kHelp);
    const int attributes[] = {kFormat,       kRgba, kDepthBits,    0,     kProfile, kCoreProfile,
                              kMajorVersion, major, kMinorVersion, minor, 0};
    void* context = create(attributes, nullptr);
    if (context == nullptr)
        return fail(Fault::file, fmt::format("OSMesa gives no OpenGL {}.{} core profile", major, minor));
    // OSMesa insists on a default framebuffer; gobo draws to framebuffer objects only.
    constexpr int kSide = 4;
    const auto window = std::make_shared<std::array<unsigned char, 4 * kSide * kSide>>();
    platform.make_current = [=] {
        return make_current(context, window->data(), kUnsignedByte, kSide, kSide) != 0;
    };
    platform.destroy = [=] { destroy(context); };
    return platform;
}

/// EGL without a surface: framebuffer objects need none.
Result<Platform> open_egl(int major, int minor) {
    // From Khronos's EGL/egl.h and eglext.h, which need not be installed to build gobo.
    constexpr unsigned kPlatformSurfacelessMesa = 0x31DD;
    constexpr unsigned kOpenglApi = 0x30A2;
    constexpr int kNone = 0x3038;
    constexpr int kMajorVersion = 0x3098;
    constexpr int kMinorVersion = 0x30FB;
    constexpr int kProfileMask = 0x30FD;
    constexpr int kCoreProfileBit = 1;
    constexpr const char* kHelp =
        "install it: apt-get install libegl1 libgl1-mesa-dri, or use --backend osmesa";
    void* (*get_display)(void*) = nullptr;
    unsigned (*initialize)(void*, int*, int*) = nullptr;
    unsigned (*bind_api)(unsigned) = nullptr;
    void* (*create)(void*, void*, void*, const int*) = nullptr;
    unsigned (*destroy)(void*, void*) = nullptr;
    unsigned (*make_current)(void*, void*, void*, void*) = nullptr;
    Platform platform;
    GOBO_TRY(void* library, open_library({"libEGL.so.1", "libEGL.so"}, kHelp));
    load(library, "eglGetDisplay", get_display);
    load(library, "eglInitialize", initialize);
    load(library, "eglBindAPI", bind_api);
    load(library, "eglCreateContext", create);
    load(library, "eglDestroyContext", destroy);
    load(library, "eglMakeCurrent", make_current);
    load(library, "eglGetProcAddress", platform.function);
    // Mesa's surfaceless display, else the default one.
    const auto get_platform_display = reinterpret_cast<void* (*)(unsigned, void*, const int*)>(
        platform.function("eglGetPlatformDisplayEXT"));
    const auto is_ready = [&](void* display) {
        return display != nullptr && initialize(display, nullptr, nullptr) != 0;
    };
    void* display = get_platform_display == nullptr
                        ? nullptr
                        : get_platform_display(kPlatformSurfacelessMesa, nullptr, nullptr);
    if (!is_ready(display)) display = get_display(nullptr);
    if (!is_ready(display)) return fail(Fault::file, "EGL finds no display without a screen", kHelp);
    bind_api(kOpenglApi);
    const int attributes[] = {kMajorVersion, major,           kMinorVersion, minor,
                              kProfileMask,  kCoreProfileBit, kNone};
    // No configuration (EGL_KHR_no_config_context): there is no surface that it could be of.
    void* context = create(display, nullptr, nullptr, attributes);
    if (context == nullptr)
        return fail(Fault::file, fmt::format("EGL gives no OpenGL {}.{} core profile", major, minor), kHelp);
    platform.make_current = [=] {
        bind_api(kOpenglApi);
        return make_current(display, nullptr, nullptr, context) != 0;
    };
    // The display stays initialised: EGL shares one among all contexts of the process.
    platform.destroy = [=] {
        make_current(display, nullptr, nullptr, nullptr);
        destroy(display, context);
    };
    return platform;
}

}  // namespace

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
    GOBO_TRY(Platform opened,
             backend == Backend::osmesa ? open_osmesa(major, minor) : open_egl(major, minor));
    state->backend = backend;
    state->platform = std::shared_ptr<Platform>(new Platform(std::move(opened)), [](Platform* platform) {
        platform->destroy();
        delete platform;
    });
    if (!state->platform->make_current())
        return fail(Fault::file, fmt::format("the {} context cannot be made current", name_of(backend)));
    const auto function = [](void* from, const char* name) {
        return static_cast<const Platform*>(from)->function(name);
    };
    GladGLContext& gl = state->functions;
    const int loaded = gladLoadGLContextUserPtr(&gl, function, state->platform.get());
    state->version = 10 * GLAD_VERSION_MAJOR(loaded) + GLAD_VERSION_MINOR(loaded);
    if (state->version < version)
        return fail(Fault::file, fmt::format("the {} context offers no OpenGL {}.{} core profile",
                                             name_of(backend), major, minor));
    state->renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    return Context(std::move(state));
}

GlResources& GlResources::operator=(GlResources&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(objects_, other.objects_);
    return *this;
}

GlResources::~GlResources() {
    if (objects_.empty()) return;
    context_.make_current();
    for (const auto& [remove, name] : objects_) (context_.gl().*remove)(1, &name);
}

GLuint GlResources::make(Generate generate, Delete remove) {
    GLuint name = 0;
    (context_.gl().*generate)(1, &name);
    objects_.emplace_back(remove, name);
    return name;
}

GLuint GlResources::make_buffer(GLenum target, const void* data, std::size_t size) {
    const GLuint name = make(&GladGLContext::GenBuffers, &GladGLContext::DeleteBuffers);
    context_.gl().BindBuffer(target, name);
    context_.gl().BufferData(target, static_cast<GLsizeiptr>(size), data, GL_STATIC_DRAW);
    return name;
}

void GlResources::adopt(const Texture& texture) {
    objects_.emplace_back(&GladGLContext::DeleteTextures, texture.name);
}

}  // namespace gobo
