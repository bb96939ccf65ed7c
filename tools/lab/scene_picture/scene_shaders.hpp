// A scene's draws with the permutations that draw them, composed and validated.
#pragma once

#include <optional>
#include <vector>

#include "compose/search_path.hpp"
#include "reflect/interface.hpp"
#include "scene/scene_keys.hpp"
#include "validate/validate.hpp"

namespace gobo::scene {

/// Which permutation each draw has.
struct SceneShaders {
    std::vector<Draw> draws;
    std::vector<std::optional<std::size_t>> permutation;  ///< one per draw; nothing: it is not drawn
    Composition composition;
    Validated validated;                ///< with the SPIR-V of every stage
    std::vector<Interface> interfaces;  ///< one per permutation
};

/// Composes and validates the key of each draw (nothing: it is not drawn), each distinct key once. Errors of
/// compose() and validate().
[[nodiscard]] Result<SceneShaders> shaders_of(const Family& family, const SearchPath& search,
                                              std::vector<Draw> draws,
                                              const std::vector<std::optional<Key>>& keys, Dialect dialect,
                                              int jobs);

/// The same, with the keys that the draws call for.
[[nodiscard]] Result<SceneShaders> shaders_called_for(const Family& family, const SearchPath& search,
                                                      std::vector<Draw> draws, const Buckets& buckets,
                                                      Dialect dialect, int jobs);

}  // namespace gobo::scene
