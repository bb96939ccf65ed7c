#include "spirv/glsl_type.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace gobo {
namespace {

/// Counts of elements and locations end here, so that callers may add some; a real one is far below.
constexpr std::int64_t kMostElements = 1 << 30;

struct ScalarRow {
    std::string_view scalar;  ///< GLSL's name of one alone
    std::string_view prefix;  ///< what stands before "vec" and "mat"
    int size;                 ///< bytes
};

// In the order of Scalar.
constexpr std::array<ScalarRow, 12> kScalars = {{{"float", "", 4},
                                                 {"int", "i", 4},
                                                 {"uint", "u", 4},
                                                 {"bool", "b", 4},
                                                 {"double", "d", 8},
                                                 {"float16_t", "f16", 2},
                                                 {"int8_t", "i8", 1},
                                                 {"uint8_t", "u8", 1},
                                                 {"int16_t", "i16", 2},
                                                 {"uint16_t", "u16", 2},
                                                 {"int64_t", "i64", 8},
                                                 {"uint64_t", "u64", 8}}};

const ScalarRow& row_of(Scalar scalar) {
    return kScalars[static_cast<std::size_t>(scalar)];
}

/// 2, 3 or 4; otherwise 0.
int extent_of(char digit) {
    return digit >= '2' && digit <= '4' ? digit - '0' : 0;
}

}  // namespace

std::string GlslType::name() const {
    const ScalarRow& row = row_of(scalar);
    if (components() == 1) return std::string(row.scalar);
    if (!is_matrix()) return fmt::format("{}vec{}", row.prefix, rows);
    return columns == rows ? fmt::format("{}mat{}", row.prefix, rows)
                           : fmt::format("{}mat{}x{}", row.prefix, columns, rows);
}

int GlslType::scalar_size() const {
    return row_of(scalar).size;
}

std::optional<GlslType> glsl_type(std::string_view name) {
    for (std::size_t i = 0; i < kScalars.size(); ++i) {
        const auto scalar = static_cast<Scalar>(i);
        if (name == kScalars[i].scalar) return GlslType{scalar, 1, 1};
        if (!name.starts_with(kScalars[i].prefix)) continue;
        const std::string_view shape = name.substr(kScalars[i].prefix.size());
        if (shape.size() < 4 || extent_of(shape[3]) == 0) continue;
        const int first = extent_of(shape[3]);
        if (shape.size() == 4 && shape.starts_with("vec")) return GlslType{scalar, 1, first};
        if (!shape.starts_with("mat")) continue;
        if (shape.size() == 4) return GlslType{scalar, first, first};
        if (shape.size() == 6 && shape[4] == 'x' && extent_of(shape[5]) != 0)
            return GlslType{scalar, first, extent_of(shape[5])};
    }
    return std::nullopt;
}

int element_count(const std::vector<int>& extents) {
    std::int64_t count = 1;
    for (const int extent : extents) count = std::min<std::int64_t>(count * extent, kMostElements);
    return static_cast<int>(count);
}

std::string with_extents(std::string name, const std::vector<int>& extents) {
    for (const int extent : extents) name += extent == 0 ? "[]" : fmt::format("[{}]", extent);
    return name;
}

int location_count(std::string_view type, const std::vector<int>& extents) {
    const std::int64_t columns = glsl_type(type).value_or(GlslType{}).columns;
    return static_cast<int>(std::min<std::int64_t>(columns * element_count(extents), kMostElements));
}

}  // namespace gobo
