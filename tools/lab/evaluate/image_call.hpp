// The operands of a texture function, as its operation holds them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "lab/evaluate/program.hpp"

namespace gobo::evaluate {

/// What the decoder tells the row of an image operation, as its words. Slots are stored plus 1; 0 where the
/// call has no such operand.
struct ImageCall {
    std::uint32_t what = 0;           ///< ImageRequest::What
    std::uint32_t dimensions = 0;     ///< number of coordinates that are differentiated
    std::uint32_t is_arrayed = 0;     ///< the layer follows
    std::uint32_t is_implicit = 0;    ///< the gradients come from the quad
    std::uint32_t has_int_level = 0;  ///< the level is an integer (fetch, size)
    std::uint32_t has_int_result = 0;
    std::uint32_t has_int_coordinates = 0;
    // Slots.
    std::uint32_t image = 0;  ///< of the image's index
    std::uint32_t coordinates = 0;
    std::uint32_t divisor = 0;
    std::uint32_t reference = 0;
    std::uint32_t lod = 0;
    std::uint32_t bias = 0;
    std::uint32_t gradient_x = 0;
    std::uint32_t gradient_y = 0;
    std::uint32_t offset = 0;
    std::uint32_t sample = 0;
    std::uint32_t component = 0;  ///< of a gather
    std::uint32_t texel = 0;      ///< that is written
    // Of images without a sampler.
    std::uint32_t is_storage = 0;
    std::uint32_t texel_components = 0;
};
using ImageWords = std::array<std::uint32_t, sizeof(ImageCall) / sizeof(std::uint32_t)>;

/// Coordinates of an image without its layer.
[[nodiscard]] inline std::uint32_t dimensions_of(const spirv::Image& image) {
    if (image.dimension == spv::Dim1D || image.dimension == spv::DimBuffer) return 1;
    return image.dimension == spv::Dim3D || image.dimension == spv::DimCube ? 3 : 2;
}

/// Of an operation that is a texture function.
[[nodiscard]] inline ImageCall image_call_of(const Program& program, const Operation& operation) {
    ImageWords words{};
    std::copy_n(program.words.begin() + operation.extra, words.size(), words.begin());
    return std::bit_cast<ImageCall>(words);
}

/// Whether what the stage computes in a pixel depends on its neighbours: it takes derivatives, or samples
/// textures at a level that follows from them.
[[nodiscard]] bool needs_quads(const Program& program);

}  // namespace gobo::evaluate
