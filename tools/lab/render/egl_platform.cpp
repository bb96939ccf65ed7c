// EGL without a surface: framebuffer objects need none.
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "lab/render/platform.hpp"

namespace gobo {
namespace {

// From Khronos's EGL/egl.h and eglext.h, which need not be installed to build gobo.
using EglDisplay = void*;
using EglConfig = void*;
using EglContext = void*;
using EglSurface = void*;
using EglBoolean = unsigned;
using EglInteger = int;
constexpr unsigned platform_surfaceless_mesa = 0x31DD;
constexpr unsigned opengl_api = 0x30A2;
constexpr EglInteger egl_none = 0x3038;
constexpr EglInteger context_major_version = 0x3098;
constexpr EglInteger context_minor_version = 0x30FB;
constexpr EglInteger context_profile_mask = 0x30FD;
constexpr EglInteger core_profile_bit = 1;

constexpr const char* help = "install it: apt-get install libegl1 libgl1-mesa-dri, or use --backend osmesa";

struct Egl {
    explicit Egl(const SharedLibrary& library)
        : get_proc_address(library.symbol<Platform::Function (*)(const char*)>("eglGetProcAddress")),
          get_display(library.symbol<EglDisplay (*)(void*)>("eglGetDisplay")),
          initialize(library.symbol<EglBoolean (*)(EglDisplay, EglInteger*, EglInteger*)>("eglInitialize")),
          bind_api(library.symbol<EglBoolean (*)(unsigned)>("eglBindAPI")),
          create_context(library.symbol<EglContext (*)(EglDisplay, EglConfig, EglContext, const EglInteger*)>(
              "eglCreateContext")),
          destroy_context(library.symbol<EglBoolean (*)(EglDisplay, EglContext)>("eglDestroyContext")),
          make_current(library.symbol<EglBoolean (*)(EglDisplay, EglSurface, EglSurface, EglContext)>(
              "eglMakeCurrent")) {}

    Platform::Function (*get_proc_address)(const char*);
    EglDisplay (*get_display)(void*);
    EglBoolean (*initialize)(EglDisplay, EglInteger*, EglInteger*);
    EglBoolean (*bind_api)(unsigned);
    EglContext (*create_context)(EglDisplay, EglConfig, EglContext, const EglInteger*);
    EglBoolean (*destroy_context)(EglDisplay, EglContext);
    EglBoolean (*make_current)(EglDisplay, EglSurface, EglSurface, EglContext);
};

/// An initialised display: Mesa's surfaceless one, else the default one. Null where there is neither.
EglDisplay open_display(const Egl& egl) {
    using GetPlatformDisplay = EglDisplay (*)(unsigned, void*, const EglInteger*);
    const auto get_platform_display =
        reinterpret_cast<GetPlatformDisplay>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
    if (get_platform_display != nullptr) {
        EglDisplay display = get_platform_display(platform_surfaceless_mesa, nullptr, nullptr);
        if (display != nullptr && egl.initialize(display, nullptr, nullptr) != 0) return display;
    }
    EglDisplay display = egl.get_display(nullptr);
    return display != nullptr && egl.initialize(display, nullptr, nullptr) != 0 ? display : nullptr;
}

class EglPlatform final : public Platform {
  public:
    EglPlatform(const Egl& egl, EglDisplay display, EglContext context)
        : egl_(egl), display_(display), context_(context) {}
    // The display stays initialised: EGL shares one among all contexts of the process.
    ~EglPlatform() override {
        egl_.make_current(display_, nullptr, nullptr, nullptr);
        egl_.destroy_context(display_, context_);
    }

    bool make_current() override {
        egl_.bind_api(opengl_api);
        return egl_.make_current(display_, nullptr, nullptr, context_) != 0;
    }
    Function function(const char* name) const override { return egl_.get_proc_address(name); }

  private:
    Egl egl_;
    EglDisplay display_;
    EglContext context_;
};

}  // namespace

Result<std::unique_ptr<Platform>> open_egl(int major, int minor) {
    const auto library = SharedLibrary::open({"libEGL.so.1", "libEGL.so"}, help);
    if (!library) return tl::unexpected(library.error());
    const Egl egl(*library);
    EglDisplay display = open_display(egl);
    if (display == nullptr) return fail(Fault::file, "EGL finds no display without a screen", help);
    egl.bind_api(opengl_api);
    const std::array<EglInteger, 7> attributes = {
        context_major_version, major,   context_minor_version, minor, context_profile_mask,
        core_profile_bit,      egl_none};
    // No configuration (EGL_KHR_no_config_context): there is no surface that it could be of.
    EglContext context = egl.create_context(display, nullptr, nullptr, attributes.data());
    if (context == nullptr)
        return fail(Fault::file, fmt::format("EGL gives no OpenGL {}.{} core profile", major, minor), help);
    return std::make_unique<EglPlatform>(egl, display, context);
}

}  // namespace gobo
