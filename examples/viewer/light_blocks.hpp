// A draw's lights in the uniform blocks of the generated headers.
#pragma once

#include <glm/mat4x4.hpp>

#include "stage.hpp"

namespace viewer {

template <class Directional, class Point, class Spot>
struct LightBlocks {
    Directional directional{};
    Point point{};
    Spot spot{};
};
using ClassicLights = LightBlocks<lit::DirectionalLights, lit::PointLights, lit::SpotLights>;
using PhysicalLights = LightBlocks<pbr::DirectionalLights, pbr::PointLights, pbr::SpotLights>;

/// The lights that reach the draw, in eye space, from element 0 on, as the family `lit` or `pbr` takes them.
/// `view` takes world space to eye space. More lights of a kind than a permutation was built for are left
/// out.
template <class Blocks>
[[nodiscard]] Blocks light_blocks(const Stage& stage, const StageDraw& draw, const glm::dmat4& view);

}  // namespace viewer
