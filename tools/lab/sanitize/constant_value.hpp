// Constants of GLSL and what compilers make of operations on them, with the operations that they must not
// fold: the same as trap_rules() has for those that run.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spirv/glsl_type.hpp"

namespace gobo::sanitize {

/// A scalar, vector or matrix (column by column), or an array of such; floats rounded to single precision. Or
/// a structure of them.
struct ConstantValue {
    static constexpr int kStructure = -1;

    GlslType type;
    int elements = 0;  ///< of an array; 0 for none; kStructure
    std::vector<double> numbers;
    std::string_view structure = {};  ///< its name
    std::vector<ConstantValue> members = {};

    [[nodiscard]] bool is_float() const { return type.scalar == Scalar::float32; }
};

/// Nothing where a value is not constant, or of a kind that is not followed.
using Constant = std::optional<ConstantValue>;

/// Is told of an undefined operation: "division by zero", "FDiv 1, 0 -> inf".
using ReportFault = std::function<void(std::string_view message, const std::string& operation)>;

/// `operation` is "+", "<<", "==" and so on.
[[nodiscard]] Constant folded_binary(std::string_view operation, const Constant& a, const Constant& b,
                                     const ReportFault& report);
/// `operation` is "-", "+", "!" or "~".
[[nodiscard]] Constant folded_unary(std::string_view operation, const Constant& a);
/// A built-in function.
[[nodiscard]] Constant folded_call(std::string_view function, const std::vector<Constant>& arguments,
                                   const ReportFault& report);
/// `vec3(...)`; conversions among them.
[[nodiscard]] Constant constructed(const GlslType& type, const std::vector<Constant>& arguments,
                                   const ReportFault& report);
/// An array of the given elements.
[[nodiscard]] Constant array_of(const std::vector<Constant>& elements);
/// The value as GLSL converts it where that type is wanted: an int given to a float.
[[nodiscard]] Constant converted(const Constant& value, const GlslType& type);
/// "xy" of a vector.
[[nodiscard]] Constant components_of(const Constant& value, std::string_view names);
[[nodiscard]] Constant element_of(const Constant& value, const Constant& index);
/// The truth of a boolean scalar.
[[nodiscard]] std::optional<bool> truth_of(const Constant& value);

}  // namespace gobo::sanitize
