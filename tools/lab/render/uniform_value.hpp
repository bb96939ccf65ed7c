// Numbers on their way into a program's uniforms.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/render/leaves.hpp"
#include "lab/render/program.hpp"

namespace gobo {

/// A uniform with what it is to hold: its components, matrices column by column, arrays element by element.
/// An array may be given in part, from the leaf's element on.
struct Assignment {
    Leaf leaf;
    std::vector<double> numbers;
};

/// Fault::input, at `place`, where the count of numbers is not that of whole elements within the array, or
/// the type is none that can be supplied.
[[nodiscard]] Result<void> check(const Assignment& assignment, const Place& place);

/// Writes a member of a block at its reflected offset, with its strides and in its byte representation (a
/// bool is a 32-bit 0 or 1). Numbers beyond an integer's range become its nearest. The bytes are those of the
/// whole block; what lies outside of them is left out.
void write(const Assignment& assignment, std::vector<std::byte>& block);

/// Sets a plain uniform of the program, which must be the one in use. One that the program does not use is
/// left.
void set_uniform(const GladGLContext& gl, const Program& program, const Assignment& assignment);

}  // namespace gobo
