// A draw's lights in the uniform blocks of the generated header.
#pragma once

#include <glm/mat4x4.hpp>

#include "stage.hpp"

namespace viewer {

struct LightBlocks {
    lit::DirectionalLights directional{};
    lit::PointLights point{};
    lit::SpotLights spot{};
};

/// The lights that reach the draw, in eye space, from element 0 on. `view` takes world space to eye space.
/// More lights of a kind than a permutation was built for are left out.
[[nodiscard]] LightBlocks light_blocks(const Stage& stage, const StageDraw& draw, const glm::dmat4& view);

}  // namespace viewer
