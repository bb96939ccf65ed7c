// An interface flattened the way OpenGL names it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reflect/interface.hpp"

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

/// All uniforms of the interface, samplers excepted: blocks first, each in the order of its members.
[[nodiscard]] std::vector<Leaf> leaves_of(const Interface& interface);

/// The leaf of that name. "weights[2]" finds the element 2 of the leaf "weights", with what follows it in its
/// array counted. Nothing where there is none, or the element lies outside of the array.
[[nodiscard]] std::optional<Leaf> find_leaf(const std::vector<Leaf>& leaves, std::string_view name);

/// The name with every subscript emptied: "PointLights.lights[].position".
[[nodiscard]] std::string without_subscripts(std::string_view name);

}  // namespace gobo
