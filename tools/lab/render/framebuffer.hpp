// What is drawn to: float colour and depth, read back as pictures.
#pragma once

#include <array>

#include "lab/render/context.hpp"
#include "lab/render/image.hpp"

namespace gobo {

enum class DepthFormat { bits24, float32 };

/// A framebuffer object with one RGBA32F colour attachment and a depth attachment.
class Framebuffer {
  public:
    /// Makes it what is drawn to, all of it.
    void bind() const;
    /// Fills what is bound with a colour and the farthest depth.
    void clear(const std::array<float, 4>& background) const;
    /// Four channels, linear.
    [[nodiscard]] Image read_color() const { return read(4, GL_RGBA); }
    /// One channel, window-space depth in [0, 1].
    [[nodiscard]] Image read_depth() const { return read(1, GL_DEPTH_COMPONENT); }

  private:
    friend Result<Framebuffer> make_framebuffer(const Context& context, int width, int height,
                                                DepthFormat depth);
    Framebuffer(const Context& context, int width, int height)
        : resources_(context), width_(width), height_(height) {}
    [[nodiscard]] Image read(int channels, GLenum format) const;

    GlResources resources_;
    int width_;
    int height_;
    GLuint framebuffer_ = 0;
};

/// Fault::usage where the size is not from 1 to the driver's largest.
[[nodiscard]] Result<Framebuffer> make_framebuffer(const Context& context, int width, int height,
                                                   DepthFormat depth = DepthFormat::float32);

}  // namespace gobo
