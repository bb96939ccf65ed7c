#include <nlohmann/json.hpp>

#include "family/key.hpp"
#include "gobo/scene_report.hpp"

namespace gobo {
namespace {

using nlohmann::ordered_json;

ordered_json triple(const glm::dvec3& value) {
    return {value.x, value.y, value.z};
}

ordered_json draw_json(const SceneReport& report, std::size_t index) {
    const scene::Draw& draw = report.draws[index];
    const auto& key = report.keys[index];
    ordered_json json = {{"name", draw.name}, {"node", draw.node}, {"primitive", draw.primitive}};
    json["key"] = key ? ordered_json(key_text(report.family, key->key)) : ordered_json();
    if (!draw.excluded.empty()) json["excluded"] = draw.excluded;
    if (draw.bounds)
        json["bounds"] = {{"low", triple(draw.bounds->low)}, {"high", triple(draw.bounds->high)}};
    json["effects"] = ordered_json::array();
    for (const scene::Effect& effect : draw.effects)
        json["effects"].push_back({{"name", effect.name}, {"in", effect.is_in}, {"reason", effect.reason}});
    json["missing"] = key ? key->missing : std::vector<std::string>();
    return json;
}

}  // namespace

std::string scene_json(const SceneReport& report) {
    ordered_json json = {{"family", report.family.name}, {"draws", ordered_json::array()}};
    for (std::size_t i = 0; i < report.draws.size(); ++i) json["draws"].push_back(draw_json(report, i));
    json["keys"] = ordered_json::array();
    for (const Key& key : scene::distinct_keys(report.keys))
        json["keys"].push_back(key_text(report.family, key));
    json["funnel"] = {{"full_product", report.funnel.full_product},
                      {"valid", report.funnel.valid},
                      {"draws", report.funnel.draws},
                      {"needed", report.funnel.needed},
                      {"after_light_buckets", report.funnel.bucketed},
                      {"distinct_programs", report.distinct_programs},
                      {"compiled_stages", report.compiled_stages}};
    json["bucketings"] = ordered_json::array();
    for (const scene::BucketingRow& row : report.bucketings) {
        json["bucketings"].push_back({{"buckets", scene::buckets_text(row.buckets)},
                                      {"permutations", row.permutations},
                                      {"lights_shaded", row.shaded_lights},
                                      {"lights_unused", row.shaded_lights - row.lights}});
    }
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gobo
