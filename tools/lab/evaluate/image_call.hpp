// What the decoder tells a texture function besides its operation. Internal to evaluation.
#pragma once

#include <array>
#include <cstdint>

namespace gobo::evaluate {

/// The words of an image operation. Slots are stored plus 1; 0 where the call has no such operand.
struct ImageCall {
    enum Word : std::uint32_t {
        what,          ///< ImageRequest::What
        image,         ///< slot of the image's index
        coordinates,   ///< slot
        dimensions,    ///< number of coordinates that are differentiated
        arrayed,       ///< 1 where the layer follows
        projective,    ///< slot of the divisor
        reference,     ///< slot
        lod,           ///< slot
        lod_is_whole,  ///< 1 where the level is an integer (fetch, size)
        bias,          ///< slot
        gradient_x,    ///< slot
        gradient_y,    ///< slot
        offset,        ///< slot
        sample,        ///< slot
        component,     ///< slot, of a gather
        implicit,      ///< 1 where the gradients come from the quad
        whole_result,  ///< 1 where the result is integers
        whole_coordinates,
        kWords,
    };
    std::array<std::uint32_t, kWords> words{};
};

}  // namespace gobo::evaluate
