// The stages of a program, as one table: whatever is held or done for each stage goes by its rows.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <string_view>

namespace gobo {

/// In the order in which a pipeline runs them, which is that of SPIR-V's execution models. A compute stage is
/// a program of its own.
enum class StageKind { vertex, tess_control, tess_evaluation, geometry, fragment, compute };

struct StageNames {
    StageKind kind;
    std::string_view name;   ///< in family files, interfaces, manifests and messages: "tess_control"
    std::string_view infix;  ///< in the names of files, and what glslangValidator calls it: "tesc"
    std::string_view ends;   ///< other ends of files' names, with blanks between: "vs vsh glslv"
};

inline constexpr std::array<StageNames, 6> kStages = {{
    {StageKind::vertex, "vertex", "vert", "vs vsh glslv"},
    {StageKind::tess_control, "tess_control", "tesc", "tcs"},
    {StageKind::tess_evaluation, "tess_evaluation", "tese", "tes"},
    {StageKind::geometry, "geometry", "geom", "gs"},
    {StageKind::fragment, "fragment", "frag", "fs fsh glslf"},
    {StageKind::compute, "compute", "comp", "cs"},
}};

[[nodiscard]] constexpr const StageNames& names_of(StageKind kind) {
    return kStages[static_cast<std::size_t>(kind)];
}
/// "vertex" or "tess_control".
[[nodiscard]] constexpr std::string_view name_of(StageKind kind) {
    return names_of(kind).name;
}

/// The stage called "tess_control" or "tesc".
[[nodiscard]] std::optional<StageKind> stage_named(std::string_view name);
/// The stage that the end of a file's name tells: .vert, .vs, or .vert.glsl; nothing for any other name.
[[nodiscard]] std::optional<StageKind> stage_of_file(std::string_view path);

/// Whether it may lie between the vertex and the fragment stage.
[[nodiscard]] constexpr bool lies_between(StageKind kind) {
    return kind > StageKind::vertex && kind < StageKind::fragment;
}

/// One value for each stage.
template <class Value>
struct PerStage {
    std::array<Value, kStages.size()> values = {};

    [[nodiscard]] constexpr Value& operator[](StageKind kind) {
        return values[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] constexpr const Value& operator[](StageKind kind) const {
        return values[static_cast<std::size_t>(kind)];
    }
    friend auto operator<=>(const PerStage&, const PerStage&) = default;
};

/// For each stage the number of the one that a program has in a list of stages; -1 where it has none.
struct StageNumbers : PerStage<int> {
    constexpr StageNumbers() { values.fill(-1); }
    constexpr StageNumbers(int vertex, int fragment) : StageNumbers() {
        (*this)[StageKind::vertex] = vertex;
        (*this)[StageKind::fragment] = fragment;
    }
    /// Whether it has the vertex and the fragment stage and no other.
    [[nodiscard]] constexpr bool is_usual_pair() const {
        for (const StageNames& stage : kStages)
            if (((*this)[stage.kind] >= 0) !=
                (stage.kind == StageKind::vertex || stage.kind == StageKind::fragment))
                return false;
        return true;
    }
    friend auto operator<=>(const StageNumbers&, const StageNumbers&) = default;
};

}  // namespace gobo
