#include "lab/render/framebuffer.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace gobo {
namespace {

GLuint make_renderbuffer(const GladGLContext& gl, GLenum format, int width, int height) {
    GLuint name = 0;
    gl.GenRenderbuffers(1, &name);
    gl.BindRenderbuffer(GL_RENDERBUFFER, name);
    gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    return name;
}

}  // namespace

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : context_(other.context_),
      width_(other.width_),
      height_(other.height_),
      framebuffer_(std::exchange(other.framebuffer_, 0)),
      color_(std::exchange(other.color_, 0)),
      depth_(std::exchange(other.depth_, 0)) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(color_, other.color_);
    std::swap(depth_, other.depth_);
    return *this;
}

Framebuffer::~Framebuffer() {
    if (framebuffer_ == 0) return;
    context_.make_current();
    const GladGLContext& gl = context_.gl();
    gl.DeleteFramebuffers(1, &framebuffer_);
    gl.DeleteRenderbuffers(1, &color_);
    gl.DeleteRenderbuffers(1, &depth_);
}

void Framebuffer::bind() const {
    context_.make_current();
    context_.gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    context_.gl().Viewport(0, 0, width_, height_);
}

void Framebuffer::clear(const std::array<float, 4>& background) const {
    const GladGLContext& gl = context_.gl();
    gl.ClearColor(background[0], background[1], background[2], background[3]);
    gl.ClearDepth(1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Image Framebuffer::read_color() const {
    return read(4, GL_RGBA);
}

Image Framebuffer::read_depth() const {
    return read(1, GL_DEPTH_COMPONENT);
}

Image Framebuffer::read(int channels, GLenum format) const {
    bind();
    Image upside_down(width_, height_, channels);
    context_.gl().PixelStorei(GL_PACK_ALIGNMENT, 4);
    context_.gl().ReadPixels(0, 0, width_, height_, format, GL_FLOAT, upside_down.values.data());
    Image image(width_, height_, channels);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(width_) * channels;
    for (std::ptrdiff_t y = 0; y < height_; ++y)
        std::copy_n(upside_down.values.begin() + (height_ - 1 - y) * row, row,
                    image.values.begin() + y * row);
    return image;
}

Result<Framebuffer> make_framebuffer(const Context& context, int width, int height, DepthFormat depth) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest)
        return fail(Fault::usage, fmt::format("cannot draw a picture of {} x {} pixels", width, height),
                    fmt::format("choose both from 1 to {}", largest));
    Framebuffer framebuffer(context, width, height);
    gl.GenFramebuffers(1, &framebuffer.framebuffer_);
    framebuffer.color_ = make_renderbuffer(gl, GL_RGBA32F, width, height);
    const GLenum format = depth == DepthFormat::bits24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32F;
    framebuffer.depth_ = make_renderbuffer(gl, format, width, height);
    framebuffer.bind();
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, framebuffer.color_);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, framebuffer.depth_);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail(Fault::file,
                    fmt::format("the driver gives no framebuffer of {} x {} float pixels", width, height));
    return framebuffer;
}

}  // namespace gobo
