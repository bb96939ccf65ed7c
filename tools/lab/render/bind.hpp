// From an interface and values by name to what each uniform is set to: its leaves, the value that each gets,
// and how that is laid out in a block.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "family/family.hpp"
#include "lab/render/program.hpp"
#include "reflect/interface.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {

/// A uniform of scalar, vector or matrix type, or an array of such: a member of a block, or a plain one.
struct Leaf {
    std::string name;   ///< "PointLights.lights[0].position"; a member always after its block's name
    std::string block;  ///< empty for a plain uniform
    std::string type;   ///< GLSL's name
    int count = 1;  ///< the extent of the innermost array dimension; outer ones are spelled out in the name
    bool is_array = false;
    int offset = 0;  ///< bytes from the start of the block; 0 outside blocks, as all strides are
    int array_stride = 0;
    int matrix_stride = 0;
    bool row_major = false;

    friend bool operator==(const Leaf&, const Leaf&) = default;
};

/// All uniforms of the interface, samplers excepted, named as OpenGL names them: blocks first, each in the
/// order of its members.
[[nodiscard]] std::vector<Leaf> leaves_of(const Interface& interface);

/// One object seen by one camera: what the values are made of that the renderer supplies by name.
struct ViewedObject {
    glm::dmat4 model{1};        ///< object to world space
    glm::dmat4 view{1};         ///< world to eye space
    glm::dmat4 projection{1};   ///< eye to clip space
    glm::dvec2 viewport{1, 1};  ///< pixels
};

/// The source that a name's usual spelling tells; empty where it tells none. Only the last part of a member's
/// name counts. Blanks between words, a prefix (`u_`, `a_`, `in_`, `uMVP`, `aPosition`, ...) and "matrix" at
/// the end do not matter. The sources with their spellings are tables in bind.cpp.
[[nodiscard]] std::string_view uniform_source_of(std::string_view name);
[[nodiscard]] std::string_view attribute_source_of(std::string_view name);

/// An error at the place of a value whose source is none of those known.
[[nodiscard]] tl::unexpected<Diagnostics> unknown_source(const RenderValue& value,
                                                         const std::vector<std::string>& known);
/// That something has no value in the family's [render] table.
[[nodiscard]] Diagnostic no_value(std::string message);

/// A uniform with what it is to hold: its components, matrices column by column, arrays element by element.
/// An array may be given in part, from the leaf's element on.
struct Assignment {
    Leaf leaf;
    std::vector<double> numbers;
};

/// The values of one object's uniforms, and warnings for those that have none and stay 0.
struct ResolvedUniforms {
    std::vector<Assignment> assignments;
    Diagnostics warnings;
};

/// A later value overrides an earlier one, and any of them what the name's usual spelling tells (see
/// uniform_source_of()). A value for a block or uniform that the interface lacks, or for an element beyond
/// its array, is left out: a family's table serves all of its permutations. Errors (Fault::input, at the
/// value's place): a member that a block does not have, an unknown source, numbers that do not fit the type.
[[nodiscard]] Result<ResolvedUniforms> resolve_uniforms(const Interface& interface,
                                                        const std::vector<RenderValue>& values,
                                                        const ViewedObject& object);

/// The bytes of a uniform block: each of its members at its reflected offset, with its strides and in its
/// byte representation (a bool is a 32-bit 0 or 1). Numbers beyond an integer's range become its nearest.
[[nodiscard]] std::vector<std::byte> bytes_of(const Block& block, const std::vector<Assignment>& assignments);
/// The push constants of all stages: one memory, of which each stage's block is a view from its first byte.
[[nodiscard]] std::vector<std::byte> pushed_bytes(const Interface& interface,
                                                  const std::vector<Assignment>& assignments);

/// Sets a plain uniform of the program, which must be the one in use. One that the program does not use is
/// left.
void set_uniform(const GladGLContext& gl, const Program& program, const Assignment& assignment);

}  // namespace gobo
