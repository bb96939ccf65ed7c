// What every driver of a dialect must offer, and what a program needs.
#pragma once

#include <string>

#include "compose/composition.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// Minimum values of implementation limits (OpenGL 4.5 core, tables 23.53 to 23.64; OpenGL 3.3 core,
/// table 6.40 ff.; OpenGL ES 3.0, tables 6.29 to 6.33).
struct Limits {
    int uniform_block_size = 16384;     ///< MAX_UNIFORM_BLOCK_SIZE, bytes
    int uniform_blocks_per_stage = 12;  ///< MAX_VERTEX_UNIFORM_BLOCKS, MAX_FRAGMENT_UNIFORM_BLOCKS
    int uniform_buffer_bindings = 84;   ///< MAX_UNIFORM_BUFFER_BINDINGS
    int varying_components = 60;        ///< MAX_VARYING_COMPONENTS
    int varying_vectors = 15;           ///< MAX_VARYING_VECTORS: locations of four components each
    int samplers_per_stage = 16;        ///< MAX_TEXTURE_IMAGE_UNITS
    int vertex_attributes = 16;         ///< MAX_VERTEX_ATTRIBS
};

[[nodiscard]] Limits limits_of(Dialect dialect);

/// What of a program goes beyond the limits, one error each, at `place`. `vertex` and `fragment` are the
/// stages' own interfaces.
[[nodiscard]] Diagnostics beyond_limits(const Interface& vertex, const Interface& fragment,
                                        const Limits& limits, const Place& place);

/// What the fragment stage reads that the vertex stage does not write, matched by location where both state
/// one, otherwise by name: OpenGL refuses to link it.
[[nodiscard]] Diagnostics unwritten_inputs(const Interface& vertex, const Interface& fragment,
                                           const Place& place);

}  // namespace gobo
