// What `gobo render` can supply, by the names that [render] of a family file uses.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace gobo {

inline constexpr std::array<std::string_view, 26> kRenderSources = {
    // matrices
    "model", "view", "projection", "model_view", "view_projection", "model_view_projection", "inverse_view",
    "normal_matrix", "world_normal_matrix",
    // vectors
    "camera_position", "viewport", "eye_point", "eye_point_and", "eye_direction",
    // attributes
    "position", "normal", "texcoord", "color", "tint", "material_number", "tile",
    // samplers
    "texture_checker", "texture_white", "texture_ramp", "texture_normal", "texture_lattice"};

[[nodiscard]] constexpr bool is_render_source(std::string_view name) {
    return std::find(kRenderSources.begin(), kRenderSources.end(), name) != kRenderSources.end();
}

}  // namespace gobo
