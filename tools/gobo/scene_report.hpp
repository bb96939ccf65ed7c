// What `gobo scene` tells, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "family/family.hpp"
#include "scene/scene_keys.hpp"

namespace gobo {

struct SceneReport {
    const Family& family;
    const std::vector<scene::Draw>& draws;
    std::vector<std::optional<scene::DrawKey>> keys;  ///< per draw
    std::vector<scene::BucketingRow> bucketings;
    scene::Buckets buckets;  ///< those that `keys` follow
    scene::Funnel funnel;
    std::size_t distinct_programs = 0;  ///< pairs of stages
    std::size_t compiled_stages = 0;
};

/// Per draw its key and each effect with its reason; then the keys, the funnel and the table of bucketings.
[[nodiscard]] std::string scene_text(const SceneReport& report);

/// {"family", "draws": [{"name", "node", "primitive", "key", "excluded", "bounds", "effects": [{"name", "in",
/// "reason"}], "missing"}], "keys", "funnel", "bucketings"}; `key` is null for what is not drawn.
[[nodiscard]] std::string scene_json(const SceneReport& report);

}  // namespace gobo
