// OpenGL without a window: Mesa's software renderer, loaded at run time, and a float framebuffer.
#pragma once

#include <glad/gl.h>

#include "picture.hpp"

namespace teapot {

/// An OpenGL 4.5 core context that is current for as long as this lives, drawing to linear radiance.
class Offscreen {
  public:
    /// `size` in pixels of the framebuffer. Throws std::runtime_error where there is no OSMesa.
    explicit Offscreen(Size size);
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;
    ~Offscreen();

    /// OpenGL's functions.
    const GladGLContext& gl() const { return gl_; }
    /// What has been drawn.
    Radiance read() const;

  private:
    Size size_;
    void* context_ = nullptr;
    void (*destroy_)(void*) = nullptr;
    unsigned char window_[16] = {};  // OSMesa wants a window to draw to: 2 x 2 pixels, not used
    GladGLContext gl_ = {};
};

}  // namespace teapot
