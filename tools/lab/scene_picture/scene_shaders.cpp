#include "lab/scene_picture/scene_shaders.hpp"

#include <algorithm>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "validate/validate.hpp"

namespace gobo::scene {

Result<SceneShaders> shaders_of(const Family& family, const SearchPath& search, std::vector<Draw> draws,
                                const std::vector<std::optional<Key>>& keys, Dialect dialect, int jobs) {
    std::vector<Key> distinct;
    for (const auto& key : keys)
        if (key) distinct.push_back(*key);
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    Result<Composition> composition = compose(family, distinct, search, dialect);
    if (!composition) return tl::unexpected(composition.error());
    SceneShaders shaders;
    shaders.draws = std::move(draws);
    shaders.composition = std::move(*composition);
    ValidateOptions options;
    options.jobs = jobs;
    options.keep_spirv = true;
    shaders.validated = validate(family, shaders.composition, options);
    if (exit_status(shaders.validated.diagnostics) != 0) return tl::unexpected(shaders.validated.diagnostics);
    for (const Permutation& permutation : shaders.composition.permutations)
        shaders.interfaces.push_back(interface_of(shaders.validated, permutation));
    for (const auto& key : keys) {
        std::optional<std::size_t>& permutation = shaders.permutation.emplace_back();
        if (key)
            permutation = static_cast<std::size_t>(std::lower_bound(distinct.begin(), distinct.end(), *key) -
                                                   distinct.begin());
    }
    return shaders;
}

Result<SceneShaders> shaders_called_for(const Family& family, const SearchPath& search,
                                        std::vector<Draw> draws, const Buckets& buckets, Dialect dialect,
                                        int jobs) {
    const auto called_for = keys_called_for(family, draws, buckets, name_of(dialect));
    if (!called_for) return tl::unexpected(called_for.error());
    std::vector<std::optional<Key>> keys;
    for (const auto& key : *called_for) keys.push_back(key ? std::optional(key->key) : std::nullopt);
    return shaders_of(family, search, std::move(draws), keys, dialect, jobs);
}

}  // namespace gobo::scene
