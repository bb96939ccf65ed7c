#include "emit/std140_type.hpp"

#include <functional>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

namespace gobo {
namespace {

/// A GLSL scalar, vector or matrix type, taken apart.
struct GlslType {
    std::string_view number;  ///< of C++
    char letter = 'f';        ///< f, i, u, d or b
    int columns = 1;
    int rows = 1;

    [[nodiscard]] int number_size() const { return letter == 'd' ? 8 : 4; }
};

std::string_view number_of(char letter) {
    switch (letter) {
        case 'i':
            return "std::int32_t";
        case 'u':
            return "std::uint32_t";
        case 'd':
            return "double";
        case 'b':
            return "std140::Bool";
        default:
            return "float";
    }
}

bool is_extent(char digit) {
    return digit >= '2' && digit <= '4';
}

std::optional<GlslType> scalar(std::string_view name) {
    if (name == "float") return GlslType{number_of('f'), 'f'};
    if (name == "int") return GlslType{number_of('i'), 'i'};
    if (name == "uint") return GlslType{number_of('u'), 'u'};
    if (name == "double") return GlslType{number_of('d'), 'd'};
    if (name == "bool") return GlslType{number_of('b'), 'b'};
    return std::nullopt;
}

/// vec3, dmat4x3 and so on.
std::optional<GlslType> vector_or_matrix(std::string_view name) {
    char letter = 'f';
    if (!name.empty() && std::string_view("iudb").find(name.front()) != std::string_view::npos) {
        letter = name.front();
        name.remove_prefix(1);
    }
    const bool is_matrix = name.starts_with("mat");
    if (!is_matrix && !name.starts_with("vec")) return std::nullopt;
    const std::string_view extents = name.substr(3);
    if (extents.empty() || !is_extent(extents.front())) return std::nullopt;
    const int first = extents.front() - '0';
    if (extents.size() == 1) return GlslType{number_of(letter), letter, is_matrix ? first : 1, first};
    if (!is_matrix || extents.size() != 3 || extents[1] != 'x' || !is_extent(extents[2])) return std::nullopt;
    return GlslType{number_of(letter), letter, first, extents[2] - '0'};
}

CppMemberType vector_type(const GlslType& glsl) {
    CppMemberType result;
    result.size = glsl.rows * glsl.number_size();
    const std::string prefix = glsl.letter == 'f' ? "" : std::string(1, glsl.letter);
    result.type =
        glsl.rows == 1 ? std::string(glsl.number) : fmt::format("std140::{}vec{}", prefix, glsl.rows);
    return result;
}

std::optional<CppMemberType> matrix_type(const GlslType& glsl, const Member& member) {
    CppMemberType result;
    const int lines = member.row_major ? glsl.rows : glsl.columns;
    const int line_size = (member.row_major ? glsl.columns : glsl.rows) * glsl.number_size();
    if (member.matrix_stride < line_size) return std::nullopt;
    result.size = lines * member.matrix_stride;
    const std::string shape = fmt::format("<{}, {}, {}", glsl.columns, glsl.rows, glsl.number);
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
    const int inner = std::accumulate(member.array.begin() + 1, member.array.end(), 1, std::multiplies<>());
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
    std::optional<GlslType> glsl = scalar(member.type);
    if (!glsl) glsl = vector_or_matrix(member.type);
    if (!glsl) return std::nullopt;
    const auto element = glsl->columns == 1 ? vector_type(*glsl) : matrix_type(*glsl, member);
    if (!element) return std::nullopt;
    return cpp_array_of(element->type, element->size, member);
}

}  // namespace gobo
