#include "core/stage.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace gobo {

std::optional<StageKind> stage_named(std::string_view name) {
    for (const StageNames& stage : kStages)
        if (name == stage.name || name == stage.infix) return stage.kind;
    return std::nullopt;
}

std::optional<StageKind> stage_of_file(std::string_view path) {
    constexpr std::string_view kGlsl = ".glsl";
    if (path.ends_with(kGlsl)) path.remove_suffix(kGlsl.size());
    const auto dot = path.rfind('.');
    if (dot == std::string_view::npos) return std::nullopt;
    const std::string_view end = path.substr(dot + 1);
    for (const StageNames& stage : kStages)
        if (end == stage.infix || std::ranges::count(split(stage.ends, ' '), end) > 0) return stage.kind;
    return std::nullopt;
}

}  // namespace gobo
