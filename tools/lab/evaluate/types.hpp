// The types of a module, flattened: every value is a row of scalar slots, matrices column by column.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "lab/evaluate/module.hpp"

namespace gobo::evaluate {

/// What one slot holds.
enum class Scalar : std::uint8_t { real, signed_integer, unsigned_integer, boolean, image };

[[nodiscard]] inline bool is_integer(Scalar scalar) {
    return scalar == Scalar::signed_integer || scalar == Scalar::unsigned_integer;
}

struct ImageType {
    std::uint32_t dimension = 0;  ///< spv::Dim
    bool depth = false;
    bool arrayed = false;
    bool multisampled = false;
};

struct Type {
    enum class Shape { none, nothing, scalar, vector, matrix, array, structure, image, pointer, function };
    Shape shape = Shape::none;
    Scalar scalar = Scalar::real;  ///< of a scalar, vector or matrix
    std::uint32_t element = 0;     ///< type of a vector's, matrix's or array's elements, or pointed to
    std::uint32_t count = 0;       ///< of elements
    std::uint32_t slots = 0;
    std::uint32_t depth = 0;             ///< of nesting
    std::uint32_t storage = 0;           ///< of a pointer: spv::StorageClass
    std::vector<std::uint32_t> members;  ///< of a structure: their types
    ImageType image;
};

/// The types of a module by id.
class Types {
  public:
    /// The type of that id; one of shape `none` where there is none.
    [[nodiscard]] const Type& operator[](std::uint32_t id) const;
    /// What each slot of a value of this type holds.
    [[nodiscard]] std::vector<Scalar> layout(std::uint32_t id) const;
    /// The type of element or member `index`, or 0 where there is none.
    [[nodiscard]] std::uint32_t part(std::uint32_t id, std::uint32_t index) const;
    /// The first slot of element or member `index` inside the value.
    [[nodiscard]] std::uint32_t offset(std::uint32_t id, std::uint32_t index) const;
    /// "vec3", "mat4", "int": scalars, vectors and matrices as GLSL names them; empty for others.
    [[nodiscard]] std::string glsl_name(std::uint32_t id) const;

    void add(std::uint32_t id, Type type) { types_[id] = std::move(type); }

  private:
    std::unordered_map<std::uint32_t, Type> types_;
};

/// The types that the module declares. A type that evaluation does not know (64-bit numbers, run-time arrays)
/// is an error that names it; values are limited to 2^18 slots, types to 32 levels of nesting.
[[nodiscard]] Result<Types> read_types(const Module& module);

}  // namespace gobo::evaluate
