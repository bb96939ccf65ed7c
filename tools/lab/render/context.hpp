// Headless OpenGL contexts: OSMesa and EGL without a surface, both loaded at run time.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glad/gl.h>

#include "core/diagnostic.hpp"

namespace gobo {

enum class Backend {
    osmesa,  ///< Mesa's software renderer in the calling process
    egl,     ///< EGL on Mesa's surfaceless platform, or the default display
};

/// "osmesa" or "egl".
[[nodiscard]] std::string_view name_of(Backend backend);
/// The backend of that name. Fault::usage otherwise.
[[nodiscard]] Result<Backend> backend_of(std::string_view name);

struct Platform;

/// A core-profile OpenGL context with its functions. Copies share it; it is destroyed with the last of them,
/// so that objects made in it (programs, framebuffers) hold a copy. Used by one thread at a time.
class Context {
  public:
    /// Makes it the calling thread's current context. Every function of this folder that takes a Context does
    /// so.
    void make_current() const;
    /// OpenGL's functions. Null pointers: those of a version above version().
    [[nodiscard]] const GladGLContext& gl() const { return state_->functions; }
    [[nodiscard]] Backend backend() const { return state_->backend; }
    /// 10 * major + minor, of what the driver gave: at least what was asked for.
    [[nodiscard]] int version() const { return state_->version; }
    /// GL_RENDERER: every figure measured here is to be labelled with it.
    [[nodiscard]] const std::string& renderer() const { return state_->renderer; }

  private:
    struct State {
        Backend backend = Backend::osmesa;
        std::shared_ptr<Platform> platform;
        GladGLContext functions = {};
        int version = 0;
        std::string renderer;
    };
    friend Result<Context> open_context(Backend backend, int version);
    explicit Context(std::shared_ptr<const State> state) : state_(std::move(state)) {}

    std::shared_ptr<const State> state_;
};

/// Opens a context and makes it current. `version` is 10 * major + minor, from 33 to 45.
/// Fault::file where the library is absent (the help names the package) or gives no such context.
[[nodiscard]] Result<Context> open_context(Backend backend, int version = 45);

/// A texture object with what it is bound to.
struct Texture {
    GLuint name = 0;
    GLenum target = GL_TEXTURE_2D;
};

/// Buffers, textures, framebuffers and the like of one context, deleted together.
class GlResources {
  public:
    using Generate = PFNGLGENBUFFERSPROC GladGLContext::*;
    using Delete = PFNGLDELETEBUFFERSPROC GladGLContext::*;

    explicit GlResources(const Context& context) : context_(context) {}
    GlResources(GlResources&& other) noexcept = default;
    GlResources& operator=(GlResources&& other) noexcept;
    ~GlResources();

    [[nodiscard]] const Context& context() const { return context_; }
    /// One object, made as by glGenBuffers and deleted as by glDeleteBuffers.
    [[nodiscard]] GLuint make(Generate generate, Delete remove);
    GLuint make_buffer(GLenum target, const void* data, std::size_t size);
    void adopt(const Texture& texture);

  private:
    Context context_;
    std::vector<std::pair<Delete, GLuint>> objects_;
};

}  // namespace gobo
