// Error against cost: every quality that is worth a look, for every combination of effects, on every scene.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/file_system.hpp"
#include "compose/search_path.hpp"
#include "lab/study/curves.hpp"
#include "lab/study/journal.hpp"
#include "lab/study/measure.hpp"
#include "lab/study/timing.hpp"
#include "lab/study/weights.hpp"

namespace gobo::study {

/// What has been done of what there is to do.
using Progress = std::function<void(std::string_view what, std::size_t done, std::size_t total)>;

struct StudyOptions {
    StudyPlan plan;
    std::vector<std::string> effects;  ///< key texts; empty: those of the plan
    bool quick = false;                ///< the plan's quick effects, no curves but the tessellation's
    int jobs = 1;
    Weights weights;  ///< decide which qualities are near the front
    Progress progress = [](std::string_view, std::size_t, std::size_t) {};
};

/// One key of one combination of effects: on each scene, and over all of them.
struct KeyResult {
    Key key;
    std::vector<Measurement> scenes;  ///< in the order of Study::scenes
    std::optional<Timing> timing;
    std::optional<double> instructions;  ///< of a fragment, by callgrind
};

/// One combination of effects. The most accurate key stands first.
struct EffectsResult {
    Key effects;
    std::vector<KeyResult> keys;
    std::size_t considered = 0;      ///< qualities there are; those far from the front are left out
    std::optional<Control> control;  ///< of the timings, where there are some
};

struct Study {
    StudyPlan plan;
    std::vector<std::string> scenes;
    std::vector<EffectsResult> effects;
    std::vector<CurvePoint> curves;
    std::vector<ChangeResult> changes;
};

/// Measures errors and operations; no timings. The same inputs give the same numbers, whatever the jobs and
/// however often it was interrupted. `shipped` holds the meshes.
[[nodiscard]] Result<Study> run_study(const FileSystem& shipped, const Family& family,
                                      const SearchPath& search, const StudyOptions& options,
                                      Journal& journal);

/// Measures certain keys of one combination of effects on the plan's scenes; the most accurate one must stand
/// first.
[[nodiscard]] Result<EffectsResult> measure_keys(const FileSystem& shipped, const Family& family,
                                                 const SearchPath& search, const Key& effects,
                                                 const std::vector<Key>& keys, const StudyOptions& options,
                                                 Journal& journal);

}  // namespace gobo::study
