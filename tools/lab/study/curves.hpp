// Errors along a line: against tessellation, against a uniform such as the shininess; and two models
// compared.
#pragma once

#include <string>
#include <vector>

#include "lab/study/error_figures.hpp"
#include "lab/study/journal.hpp"
#include "lab/study/variants.hpp"

namespace gobo::study {

/// One value of a feature at one number of a curve.
struct CurvePoint {
    std::string feature;
    std::string value;
    std::string over;  ///< what the number is: "slices", "Material.shininess"
    double number = 0;
    std::string effects;
    ErrorFigures error;  ///< of the model, fp64 against the reference
    ErrorFigures total;  ///< fp32 against the reference
};

/// Two models compared: no error.
struct ChangeResult {
    StudyChange change;
    ErrorFigures difference;
    double largest = 0;  ///< radiance of the first
};

/// The key with the features that say where light is computed at their most accurate values, canonical.
[[nodiscard]] Key at_full_rate(const Family& family, const StudyPlan& plan, const Key& key);

/// Each value of the plan's rate features on spheres of 8 to 256 slices, and the plan's own curves (not where
/// `quick`).
[[nodiscard]] Result<std::vector<CurvePoint>> measure_curves(const FileSystem& shipped, const Family& family,
                                                             const SearchPath& search, const StudyPlan& plan,
                                                             bool quick, int jobs, Journal& journal);

/// The plan's changes of model on its first scene, both exact.
[[nodiscard]] Result<std::vector<ChangeResult>> measure_changes(const FileSystem& shipped,
                                                                const Family& family,
                                                                const SearchPath& search,
                                                                const StudyPlan& plan);

}  // namespace gobo::study
