// A permutation as a picture.
#pragma once

#include <array>
#include <vector>

#include "lab/render/draw_list.hpp"
#include "lab/render/framebuffer.hpp"

namespace gobo {

/// From where a picture is taken, and onto what.
struct View {
    Camera camera;
    int width = 512;  ///< pixels
    int height = 512;
    std::array<float, 4> background = {0, 0, 0, 1};  ///< linear
    DepthFormat depth = DepthFormat::float32;
};

/// What was drawn.
struct Picture {
    Image color;           ///< linear, four channels, as the fragment stage's first output wrote it
    Image depth;           ///< window space, 1 where nothing was drawn
    Diagnostics warnings;  ///< attributes, uniforms and samplers without a value
};

/// Links the two stages, supplies their uniforms and attributes, draws the objects once and reads the result.
/// `values` are those of the family's [render] table; samplers that `textures` names get those. Errors: of
/// the driver, at the piece and its own line; of the values (see resolve_uniforms()); of the size.
[[nodiscard]] Result<Picture> render_permutation(const Context& context, const std::vector<StageText>& stages,
                                                 const Interface& interface,
                                                 const std::vector<Object>& objects,
                                                 const std::vector<RenderValue>& values, const View& view,
                                                 const GivenTextures& textures = {});

}  // namespace gobo
