// Textures that answer from data: what a caller may give for the samplers of a stage.
#pragma once

#include <array>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// What a texture of one colour answers: its size (`side` texels, as many levels as that has), the colour, or
/// for a shadow lookup whether the reference is at most its first component.
[[nodiscard]] std::array<double, 4> answer(const std::array<double, 4>& color, const ImageRequest& request,
                                           double side = 4);

/// Depths, layer after layer, row after row from y = 0: a sampler2DArrayShadow.
struct DepthTexels {
    int width = 1;
    int height = 1;
    int layers = 1;
    std::vector<double> depths;
};

/// As OpenGL with one level, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_COMPARE_REF_TO_TEXTURE and GL_LEQUAL: the four
/// comparisons around, weighted. A fetch answers the depth itself.
[[nodiscard]] std::array<double, 4> answer(const DepthTexels& texels, const ImageRequest& request);

}  // namespace gobo::evaluate
