// The C++ type of a member of a uniform block, from its reflected layout.
#include <string_view>

#include <fmt/format.h>

#include "emit/sections.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

std::string_view number_of(Scalar scalar) {
    switch (scalar) {
        case Scalar::int32:
            return "std::int32_t";
        case Scalar::uint32:
            return "std::uint32_t";
        case Scalar::float64:
            return "double";
        case Scalar::boolean:
            return "std140::Bool32";
        default:
            return "float";
    }
}

CppMemberType vector_type(const GlslType& glsl) {
    std::string type = glsl.rows == 1 ? std::string(number_of(glsl.scalar)) : "std140::" + glsl.name();
    return {std::move(type), {}, glsl.column_size()};
}

std::optional<CppMemberType> matrix_type(const GlslType& glsl, const Member& member) {
    CppMemberType result;
    const int lines = member.row_major ? glsl.rows : glsl.columns;
    const int line_size = (member.row_major ? glsl.columns : glsl.rows) * glsl.scalar_size();
    if (member.matrix_stride < line_size) return std::nullopt;
    result.size = lines * member.matrix_stride;
    const std::string shape = fmt::format("<{}, {}, {}", glsl.columns, glsl.rows, number_of(glsl.scalar));
    if (member.row_major) {
        result.type = fmt::format("std140::RowMajorMatrix{}, {}>", shape, member.matrix_stride);
    } else if (member.matrix_stride > line_size) {
        result.type = fmt::format("std140::Matrix{}, {}>", shape, member.matrix_stride);
    } else {
        result.type = fmt::format("std140::PlainMatrix{}>", shape);
    }
    if (result.type == "std140::Matrix<2, 2, float, 16>") result.type = "std140::Mat2";
    if (result.type == "std140::Matrix<3, 3, float, 16>") result.type = "std140::Mat3";
    if (result.type == "std140::PlainMatrix<4, 4, float>") result.type = "std140::mat4";
    return result;
}

}  // namespace

int element_stride(const Member& member) {
    if (member.array.empty()) return 0;
    const int inner = element_count({member.array.begin() + 1, member.array.end()});
    return inner > 0 ? member.array_stride / inner : 0;
}

std::optional<CppMemberType> cpp_array_of(const std::string& element, int element_size,
                                          const Member& member) {
    CppMemberType result{element, {}, element_size};
    if (member.array.empty()) return result;
    const int stride = element_stride(member);
    if (stride < element_size) return std::nullopt;
    if (stride > element_size) result.type = fmt::format("std140::Padded<{}, {}>", element, stride);
    result.size = stride;
    for (const int extent : member.array) {
        result.extents += fmt::format("[{}]", extent);
        result.size *= extent;
    }
    return result;
}

std::optional<CppMemberType> cpp_type_of(const Member& member) {
    const std::optional<GlslType> glsl = glsl_type(member.type);
    // C++ has no types for the numbers of 8, 16 and 64 bits that extensions of GLSL know.
    if (!glsl || (glsl->scalar_size() != 4 && glsl->scalar != Scalar::float64)) return std::nullopt;
    const auto element = glsl->is_matrix() ? matrix_type(*glsl, member) : vector_type(*glsl);
    if (!element) return std::nullopt;
    return cpp_array_of(element->type, element->size, member);
}

}  // namespace gobo
