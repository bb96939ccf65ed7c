// Error against cost: every quality that is worth a look, for every combination of effects, on every scene;
// and errors along curves, models compared, and times.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "budget/budget.hpp"
#include "lab/study/journal.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {

/// What has been done of what there is to do.
using Progress = std::function<void(std::string_view what, std::size_t done, std::size_t total)>;

struct StudyOptions {
    StudyPlan plan;
    std::vector<std::string> effects;  ///< key texts; empty: those of the plan
    bool quick = false;                ///< the plan's quick effects, no curves but the tessellation's
    Weights weights;                   ///< decide which qualities are near the front
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

struct Study {
    StudyPlan plan;
    std::vector<std::string> scenes;
    std::vector<EffectsResult> effects;
    /// Each value of the plan's rate features on spheres of 8 to 256 slices, and the plan's own curves.
    std::vector<CurvePoint> curves;
    std::vector<ChangeResult> changes;  ///< on the plan's first scene, both exact
};

/// Measures errors and operations; no timings. The same inputs give the same numbers, whatever the jobs and
/// however often it was interrupted. Of each combination of effects all qualities are measured where they are
/// few; of many, those that a screening on a few points of each scene finds near the front: a quality stays
/// unless another one is both clearly cheaper and clearly more accurate.
[[nodiscard]] Result<Study> run_study(const Subject& subject, const StudyOptions& options, Journal& journal);

/// Measures certain keys of one combination of effects on the plan's scenes; the most accurate one must stand
/// first.
[[nodiscard]] Result<EffectsResult> measure_keys(const Subject& subject, const Key& effects,
                                                 const std::vector<Key>& keys, const StudyPlan& plan,
                                                 Journal& journal);

/// The keys of one combination of effects, over all scenes: what budgets choose among.
[[nodiscard]] std::vector<StudiedKey> studied_keys(const EffectsResult& result, const Weights& weights);
/// The qualities that lie on the front of any effects of a study, applied to other effects: canonical,
/// valid, each once, the most accurate one first.
[[nodiscard]] std::vector<Key> front_qualities(const Family& family, const StudiedEffects& studied,
                                               const Key& effects);

struct TimeOptions {
    int rounds = kLeastRounds;
    std::string computer;  ///< the processor's name: times of another one are not reused
    Progress progress = [](std::string_view, std::size_t, std::size_t) {};
};

/// Adds times of each combination of effects: of the most accurate key, every single choice and what lies on
/// the front over all scenes, at most 40. Each combination is one interleaved group with its own control.
/// Groups that the journal holds for this renderer are not drawn again.
[[nodiscard]] Result<void> add_times(const Subject& subject, const Context& context, const Weights& weights,
                                     const TimeOptions& options, Journal& journal, Study& study);

/// Adds the instructions of a fragment to each timed key of the combination of effects that is studied last.
[[nodiscard]] Result<void> add_instructions(const Subject& subject, const DrawCommand& command,
                                            const TimeOptions& options, Journal& journal, Study& study);

/// How the weighted cost of a fragment, or of a vertex, goes with its ranked time over all timed keys. Both
/// lists in the same order.
struct CostAndTime {
    std::vector<double> cost;
    std::vector<double> nanoseconds;
    double correlation = 0;  ///< of ranks
};
[[nodiscard]] CostAndTime cost_against_time(const Study& study, const Weights& weights, bool of_vertices);

/// For people: the worst control of each clock and which of them counts, how many permutations are not ranked
/// by it, and how cost goes with time over the others. Empty where nothing was timed.
[[nodiscard]] std::string times_summary(const Study& study, const Weights& weights);

}  // namespace gobo::study
