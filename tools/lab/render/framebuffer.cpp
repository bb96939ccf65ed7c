#include "lab/render/framebuffer.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gobo {

void Framebuffer::bind() const {
    const Context& context = resources_.context();
    context.make_current();
    context.gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    context.gl().Viewport(0, 0, width_, height_);
}

void Framebuffer::clear(const std::array<float, 4>& background) const {
    const GladGLContext& gl = resources_.context().gl();
    gl.ClearColor(background[0], background[1], background[2], background[3]);
    gl.ClearDepth(1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Image Framebuffer::read(int channels, GLenum format) const {
    bind();
    const GladGLContext& gl = resources_.context().gl();
    Image upside_down(width_, height_, channels);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, width_, height_, format, GL_FLOAT, upside_down.values.data());
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
    GlResources& resources = framebuffer.resources_;
    framebuffer.framebuffer_ =
        resources.make(&GladGLContext::GenFramebuffers, &GladGLContext::DeleteFramebuffers);
    framebuffer.bind();
    const auto attach = [&](GLenum attachment, GLenum format) {
        const GLuint name =
            resources.make(&GladGLContext::GenRenderbuffers, &GladGLContext::DeleteRenderbuffers);
        gl.BindRenderbuffer(GL_RENDERBUFFER, name);
        gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    };
    attach(GL_COLOR_ATTACHMENT0, GL_RGBA32F);
    attach(GL_DEPTH_ATTACHMENT, depth == DepthFormat::bits24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32F);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail(Fault::file,
                    fmt::format("the driver gives no framebuffer of {} x {} float pixels", width, height));
    return framebuffer;
}

}  // namespace gobo
