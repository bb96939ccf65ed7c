// Textures of colours that answer from texels, filtered as OpenGL has it: one level, GL_LINEAR.
#pragma once

#include <array>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// Row after row from t = 0, repeated beyond both ends (GL_REPEAT).
struct ColorTexels {
    int width = 1;
    int height = 1;
    std::vector<std::array<float, 4>> colors;
};

/// The faces +x -x +y -y +z -z one after the other, each row after row from t = 0; filtered across the edges
/// between them (GL_TEXTURE_CUBE_MAP_SEAMLESS).
struct CubeTexels {
    int side = 1;
    std::vector<std::array<float, 4>> colors;
};

/// Sampled: the four texels around (OpenGL 4.5, 8.14.3); in the corner of a cube three, whose mean stands for
/// the fourth (8.15). Fetched: the texel. The weights are exact where a driver's have some 8 to 24 bits.
[[nodiscard]] std::array<double, 4> answer(const ColorTexels& texels, const ImageRequest& request);
[[nodiscard]] std::array<double, 4> answer(const CubeTexels& texels, const ImageRequest& request);

}  // namespace gobo::evaluate
