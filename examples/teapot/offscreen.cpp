#include "offscreen.hpp"

#include <stdexcept>

#include <dlfcn.h>

namespace teapot {
namespace {

// From Mesa's GL/osmesa.h, which need not be installed.
using Function = void (*)();
using Create = void* (*)(const int* attributes, void* shared);
using MakeCurrent = unsigned char (*)(void* context, void* window, unsigned type, int width, int height);
using GetProcAddress = Function (*)(const char* name);
constexpr int profile = 0x33;
constexpr int core_profile = 0x34;
constexpr int major_version = 0x36;
constexpr int minor_version = 0x37;

template <class Pointer>
Pointer symbol(void* library, const char* name) {
    return reinterpret_cast<Pointer>(dlsym(library, name));
}

/// A framebuffer of linear radiance in float, with depth.
void make_framebuffer(const GladGLContext& gl, Size size) {
    GLuint framebuffer = 0;
    GLuint buffers[2] = {};
    gl.CreateFramebuffers(1, &framebuffer);
    gl.CreateRenderbuffers(2, buffers);
    gl.NamedRenderbufferStorage(buffers[0], GL_RGBA32F, size.width, size.height);
    gl.NamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT32F, size.width, size.height);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, size.width, size.height);
}

}  // namespace

Offscreen::Offscreen(Size size) : size_(size) {
    void* library = dlopen("libOSMesa.so.8", RTLD_NOW);
    if (library == nullptr) throw std::runtime_error("there is no OSMesa: apt-get install libosmesa6");
    const int attributes[] = {profile, core_profile, major_version, 4, minor_version, 5, 0};
    context_ = symbol<Create>(library, "OSMesaCreateContextAttribs")(attributes, nullptr);
    destroy_ = symbol<void (*)(void*)>(library, "OSMesaDestroyContext");
    const auto make_current = symbol<MakeCurrent>(library, "OSMesaMakeCurrent");
    if (context_ == nullptr || make_current(context_, window_, GL_UNSIGNED_BYTE, 2, 2) == 0)
        throw std::runtime_error("OSMesa gives no OpenGL 4.5");
    gladLoadGLContext(&gl_, symbol<GetProcAddress>(library, "OSMesaGetProcAddress"));
    make_framebuffer(gl_, size);
}

Offscreen::~Offscreen() {
    destroy_(context_);
}

Radiance Offscreen::read() const {
    Radiance radiance{size_, std::vector<glm::vec4>(static_cast<std::size_t>(size_.width * size_.height))};
    gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_FLOAT, radiance.pixels.data());
    return radiance;
}

}  // namespace teapot
