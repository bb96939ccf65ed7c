// The oracle's radiance at the fragments of an object.
#pragma once

#include <optional>
#include <vector>

#include "lab/study/scene_points.hpp"

namespace gobo::study {

struct OracleAnswers {
    std::vector<Color> colors;
    std::vector<bool> at_edge;  ///< something was decided within a rounding of its edge
};

/// What each fragment of the object ought to look like; nothing where the oracle does not know the variant's
/// model, or the object's uniforms mean nothing to it.
[[nodiscard]] Result<std::optional<OracleAnswers>> ask_oracle_at(const Family& family, const Variant& variant,
                                                                 const verify::SoftwareObject& object);

}  // namespace gobo::study
