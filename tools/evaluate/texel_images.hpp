// Textures of colours that answer from their texels, filtered as OpenGL does with one level and GL_LINEAR.
#pragma once

#include <array>
#include <vector>

#include "evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// Four components a texel, row after row from t = 0.
struct ColorTexels {
    int width = 1;
    int height = 1;
    std::vector<float> values;
};

/// A sampler2D's answer, with GL_REPEAT (OpenGL 4.5, 8.14.3).
[[nodiscard]] std::array<double, 4> answer(const ColorTexels& texels, const ImageRequest& request);

/// Faces +x -x +y -y +z -z, each of `side` rows from t = 0, `channels` components a texel (3 or 4; a fourth
/// that is not there is 1).
struct CubeTexels {
    int side = 1;
    int channels = 4;
    std::vector<float> values;
};

/// A samplerCube's answer, filtered across the borders of faces (OpenGL 4.5, 8.13 and
/// GL_TEXTURE_CUBE_MAP_SEAMLESS). At a corner of the cube, where three texels meet, one of them counts twice.
[[nodiscard]] std::array<double, 4> answer(const CubeTexels& texels, const ImageRequest& request);

}  // namespace gobo::evaluate
