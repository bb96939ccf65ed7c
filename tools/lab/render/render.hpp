// What is drawn to, and a permutation as a picture.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "lab/render/camera.hpp"
#include "lab/render/context.hpp"
#include "lab/render/draw_list.hpp"
#include "lab/render/image.hpp"
#include "lab/render/shadow_maps.hpp"

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
    [[nodiscard]] const Context& context() const { return resources_.context(); }

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

/// From where a picture is taken, and onto what.
struct View {
    Camera camera;
    int width = 512;  ///< pixels
    int height = 512;
    std::array<float, 4> background = {0, 0, 0, 1};  ///< linear
    DepthFormat depth = DepthFormat::float32;
};

/// What a camera sees of the world, without an object in it.
[[nodiscard]] ViewedObject viewed_from(const View& view);

/// What was drawn.
struct Picture {
    Image color;           ///< linear, four channels, as the fragment stage's first output wrote it
    Image depth;           ///< window space, 1 where nothing was drawn
    Diagnostics warnings;  ///< attributes, uniforms and samplers without a value
    Diagnostics background_alone = {};  ///< a warning where nothing but the background is seen
};

/// What `draw` draws to the framebuffer. An error where OpenGL reports one.
[[nodiscard]] Result<Picture> take_picture(const Framebuffer& framebuffer,
                                           const std::array<float, 4>& background, Diagnostics warnings,
                                           const std::function<void()>& draw);

/// Links the two stages, supplies their uniforms and attributes, draws the objects once and reads the result.
/// `values` are those of the family's [render] table; samplers that `textures` names get those. Errors: of
/// the driver, at the piece and its own line; of the values (see resolve_uniforms()); of the size.
[[nodiscard]] Result<Picture> render_permutation(const Context& context, const std::vector<StageText>& stages,
                                                 const Interface& interface,
                                                 const std::vector<Object>& objects,
                                                 const std::vector<RenderValue>& values, const View& view,
                                                 const GivenTextures& textures = {});

/// A file name for a key's text, without an end: "fog=linear point=3" gives "fog-linear+point-3". Different
/// keys have different names: beyond 200 bytes a hash of the whole text stands for the rest.
[[nodiscard]] std::string picture_name(std::string_view key_text);

/// What a family is shown with: the mesh, sized to fit a box of 3 x 1.5 x 3 about the origin, standing on a
/// plane at y = -0.75.
[[nodiscard]] std::vector<Object> demo_objects(Mesh mesh);
/// The camera that goes with them.
[[nodiscard]] Camera demo_camera();

}  // namespace gobo
