// Chooses qualities by budget: the cheapest within an error, or the most accurate within a cost.
#pragma once

#include <map>
#include <optional>
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
    bool typical = false;  ///< the error need only hold on scenes like the study's, not over the domain
    double max_cost = 0;   ///< in the unit of StudiedKey::cost; 0: no limit

    [[nodiscard]] bool is_set() const { return max_error > 0 || max_cost > 0; }
};

/// The typical error is this many times the worst one of the study's scenes: others have other meshes and
/// lights. docs/study.md says what that was tried on.
inline constexpr double kSafety = 2;

/// The promised error is at least this many times the worst one that a search of the domain found: a longer
/// search finds a little worse.
inline constexpr double kDomainSafety = 1.25;

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
    /// The worst over the family's domain, beyond what the roundings of floats explain, as a part of the
    /// light that reaches a point. Infinite: none is promised, since it hangs on the mesh. Nothing: it was
    /// not searched.
    std::optional<double> worst = std::nullopt;
};

/// On scenes like the study's.
[[nodiscard]] double typical_error(const StudiedKey& key);
/// Over the domain; nothing where none is promised: to err by no more than all of the light says nothing, and
/// what a search finds there is no bound.
[[nodiscard]] std::optional<double> promised_error(const StudiedKey& key);

/// By effects.
using StudiedEffects = std::map<Key, std::vector<StudiedKey>>;

/// The rows of all scenes of a study.csv, with costs by its columns of those chips, cycles_NAME, where any
/// are named. Errors, at `path` and the line: a missing column, a key that the family does not have (a study
/// of another version of it).
[[nodiscard]] Result<StudiedEffects> read_studied(std::string_view csv, const std::string& path,
                                                  const Family& family,
                                                  const std::vector<std::string>& gpus = {});

/// The keys that the budget allows by their typical errors and their costs, the best buy first.
[[nodiscard]] std::vector<StudiedKey> within(const std::vector<StudiedKey>& keys, const Budget& budget);

/// The best of them. Fault::input, for `subject`, where there is none; it says what is nearest.
[[nodiscard]] Result<StudiedKey> choose(const std::vector<StudiedKey>& keys, const Budget& budget,
                                        const std::string& subject);

}  // namespace gobo
