// Pipelines of shader texts, and drivers asked about them.
#pragma once

#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/cost/compile_on_chips.hpp"

namespace gobo::cost {

/// Shader texts of two stages, or of a compute stage.
struct Sources {
    std::string name;
    std::string vertex;
    std::string fragment;
    std::string descriptors;  ///< their kinds and counts, or the error
    std::string compute = {};
};

inline const std::string kVertex =
    "#version 450\nin vec4 position;\nvoid main() { gl_Position = position; }\n";

/// The stages of a permutation as gobo compiles them.
[[nodiscard]] Result<Pipeline> pipeline_of(const Family& family, const Composition& composition);
[[nodiscard]] Result<Pipeline> pipeline_of(const Sources& sources, Dialect dialect = Dialect::own);

[[nodiscard]] std::vector<Chip> chips_of(const std::vector<std::string>& names);

/// compile_on_chips() by this build's gobo-lab.
[[nodiscard]] std::vector<Result<ChipAnswers>> compile(const std::vector<Chip>& chips,
                                                       const std::vector<Pipeline>& pipelines,
                                                       CompileOptions options);

}  // namespace gobo::cost
