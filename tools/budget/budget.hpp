// Chooses qualities by budget: the cheapest within an error, or the most accurate within a cost.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "family/family.hpp"

namespace gobo {

/// The scene of a study that stands for all of them: the worst error, the mean cost.
inline constexpr const char* kAllScenes = "*";

/// What a permutation may err by and cost. Both may be given: then the error decides among what the cost
/// allows.
struct Budget {
    double max_error = 0;  ///< linear radiance; 0: no limit
    double max_cost = 0;   ///< in the unit of StudiedKey::cost; 0: no limit

    [[nodiscard]] bool is_set() const { return max_error > 0 || max_cost > 0; }
};

/// The error that a budget promises is this many times the worst one of the study: other scenes have other
/// meshes and lights. docs/study.md says what that was tried on.
inline constexpr double kSafety = 2;

/// The dialect that studies evaluate.
inline constexpr std::string_view kStudiedDialect = "450";

/// The key with every quality feature at its default, canonical: the effects that a scene calls for.
[[nodiscard]] Key effects_of(const Family& family, Key key);

/// One key of a combination of effects, over all scenes of a study.
struct StudiedKey {
    Key key;
    double error = 0;  ///< the worst
    /// Additions a fragment, the mean over scenes. By one chip, its cycles for 64 fragments; by several, the
    /// worst of their cycles, each relative to the cheapest key of the same effects. Infinite where a study
    /// has none.
    double cost = 0;
    bool on_front = false;
};

/// By effects.
using StudiedEffects = std::map<Key, std::vector<StudiedKey>>;

/// The rows of all scenes of a study.csv, with costs by its columns of those chips, cycles_NAME, where any
/// are named. Errors, at `path` and the line: a missing column, a key that the family does not have (a study
/// of another version of it).
[[nodiscard]] Result<StudiedEffects> read_studied(std::string_view csv, const std::string& path,
                                                  const Family& family,
                                                  const std::vector<std::string>& gpus = {});

/// The key that the budget buys. Fault::input, for `subject`, where there is none; it says what is nearest.
[[nodiscard]] Result<StudiedKey> choose(const std::vector<StudiedKey>& keys, const Budget& budget,
                                        const std::string& subject);

}  // namespace gobo
