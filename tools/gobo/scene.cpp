// gobo scene: what each draw of a scene needs, the keys, and how few they are.
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "gobo/commands.hpp"
#include "scene/read_scene.hpp"
#include "scene/scene_keys.hpp"

namespace gobo {
namespace {

struct SceneOptions {
    std::string scene;
    std::string family = "lit";
    std::string dialect;
    std::string bucket_lights;
    std::string camera = "all";
    scene::Thresholds thresholds;
    BudgetOptions budget;
    bool keys = false;
    bool json = false;
};

/// What the command tells.
struct SceneReport {
    const Family& family;
    const scene::SceneDraws& draws;
    std::vector<std::optional<scene::DrawKey>> keys;  ///< per draw
    std::vector<scene::BucketingRow> bucketings;
    scene::Buckets buckets;  ///< those that `keys` follow
    scene::Funnel funnel;
    std::size_t distinct_programs = 0;  ///< pairs of stages
    std::size_t compiled_stages = 0;
};

/// Names come from the file: on a terminal they must do nothing.
std::string draw_text(const SceneReport& report, std::size_t index) {
    const scene::Draw draw = report.draws.judged(index);
    if (!report.keys[index]) return one_line(fmt::format("{}: out, {}", draw.name, draw.excluded)) + "\n";
    const scene::DrawKey& key = *report.keys[index];
    std::string text = one_line(fmt::format("{}: {}", draw.name, key_text(report.family, key.key))) + "\n";
    for (const scene::Effect& effect : draw.effects)
        text +=
            one_line(fmt::format("  {}: {}, {}", effect.name, effect.is_in ? "in" : "out", effect.reason)) +
            "\n";
    for (const std::string& missing : scene::missing_effects(report.family, draw))
        text += one_line("  ! " + missing) + "\n";
    return text;
}

std::string funnel_text(const SceneReport& report) {
    const scene::Funnel& funnel = report.funnel;
    return fmt::format(
        "funnel\n"
        "  full product         {:>12}\n"
        "  valid                {:>12}\n"
        "  needed               {:>12}  by {} draw{}\n"
        "  after light buckets  {:>12}  ({})\n"
        "  distinct programs    {:>12}\n"
        "  compiled stages      {:>12}\n",
        funnel.full_product.text(), funnel.valid.text(), funnel.needed, funnel.draws,
        funnel.draws == 1 ? "" : "s", funnel.bucketed, scene::buckets_text(report.buckets),
        report.distinct_programs, report.compiled_stages);
}

/// Unused lights are what a bucketing costs: each is evaluated at every fragment, for nothing.
std::string bucketings_text(const SceneReport& report) {
    std::string text = fmt::format("{:<14}  {:>12}  {:>13}  {:>13}\n", "light buckets", "permutations",
                                   "lights shaded", "of them unused");
    for (const scene::BucketingRow& row : report.bucketings) {
        text += fmt::format("  {:<12}  {:>12}  {:>13}  {:>14}\n", scene::buckets_text(row.buckets),
                            row.permutations, row.shaded_lights, row.shaded_lights - row.lights);
    }
    return text;
}

using nlohmann::ordered_json;

ordered_json triple(const glm::dvec3& value) {
    return {value.x, value.y, value.z};
}

ordered_json draw_json(const SceneReport& report, std::size_t index) {
    const scene::Draw draw = report.draws.judged(index);
    const auto& key = report.keys[index];
    ordered_json json = {{"name", draw.name}, {"node", draw.node}, {"primitive", draw.primitive}};
    json["key"] = key ? ordered_json(key_text(report.family, key->key)) : ordered_json();
    if (!draw.excluded.empty()) json["excluded"] = draw.excluded;
    if (draw.bounds)
        json["bounds"] = {{"low", triple(draw.bounds->low)}, {"high", triple(draw.bounds->high)}};
    json["effects"] = ordered_json::array();
    for (const scene::Effect& effect : draw.effects)
        json["effects"].push_back({{"name", effect.name}, {"in", effect.is_in}, {"reason", effect.reason}});
    json["missing"] = scene::missing_effects(report.family, draw);
    return json;
}

/// Per draw its key and each effect with its reason; then the keys, the funnel and the table of bucketings.
std::string scene_text(const SceneReport& report) {
    std::string text;
    for (std::size_t i = 0; i < report.draws.size(); ++i) text += draw_text(report, i) + "\n";
    text += "keys\n";
    for (const Key& key : scene::distinct_keys(report.keys))
        text += fmt::format("  {}\n", key_text(report.family, key));
    text += "\n" + funnel_text(report) + "\n" + bucketings_text(report);
    return text;
}

/// {"family", "draws": [{"name", "node", "primitive", "key", "excluded", "bounds", "effects": [{"name", "in",
/// "reason"}], "missing"}], "keys", "funnel", "bucketings"}; `key` is null for what is not drawn.
std::string scene_json(const SceneReport& report) {
    ordered_json json = {{"family", report.family.name}, {"draws", ordered_json::array()}};
    for (std::size_t i = 0; i < report.draws.size(); ++i) json["draws"].push_back(draw_json(report, i));
    json["keys"] = ordered_json::array();
    for (const Key& key : scene::distinct_keys(report.keys))
        json["keys"].push_back(key_text(report.family, key));
    json["funnel"] = {{"full_product", report.funnel.full_product.saturated()},
                      {"valid", report.funnel.valid.saturated()},
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
    // In ASCII: names of nodes may hold what a terminal obeys.
    return json.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

Result<scene::EyePlace> place_eye(const scene::Scene& scene, const std::string& camera) {
    if (camera == "all") return scene::eye_of_cameras(scene);
    if (camera == "none") return scene::EyePlace();
    if (const auto number = number_from<std::size_t>(camera))
        if (const auto eye = scene::eye_of_cameras(scene, *number)) return eye;
    return fail(Fault::usage,
                fmt::format("--camera: no node of '{}' holds a camera '{}'", scene.path, camera),
                fmt::format("the file has {} cameras, numbered from 0; 'all' and 'none' are known too",
                            scene.cameras.size()));
}

Result<Outcome> run(const SceneOptions& options, const World& world) {
    GOBO_TRY_DO(refuse_without_budget(options.budget));
    GOBO_TRY(LoadedFamily loaded, load_family(world, options.family, options.dialect));
    GOBO_TRY_DO(narrow_domains(world, loaded, options.budget.domain));
    GOBO_TRY_DO(refuse_scenes_outside(world, loaded, {options.scene}, options.budget));
    const Family& family = loaded.family;
    const std::string_view dialect = name_of(loaded.dialect);
    GOBO_TRY(const scene::Buckets buckets, scene::parse_buckets(options.bucket_lights));
    GOBO_TRY(const scene::Scene scene,
             scene::read_scene(world.disk, options.scene, scene::reading_for(family)));
    GOBO_TRY(const scene::EyePlace eye, place_eye(scene, options.camera));
    const scene::SceneDraws draws(scene, eye, options.thresholds);
    GOBO_TRY(auto needed, scene::keys_for_scene(family, draws, buckets, dialect));
    SceneReport report{family, draws, std::move(needed.keys), {}, buckets, {}};
    GOBO_TRY(report.bucketings, scene::compare_bucketings(family, report.keys, buckets, dialect));
    GOBO_TRY(report.funnel, scene::measure_funnel(family, report.keys, buckets, dialect));
    if (options.budget.is_set()) {  // each draw's key becomes the one that the budget chooses for its effects
        std::vector<Key> keys;
        for (const auto& draw : report.keys)
            if (draw) keys.push_back(draw->key);
        GOBO_TRY(const auto choices, choose_qualities(world, loaded, options.budget, keys));
        auto choice = choices.begin();
        for (auto& draw : report.keys)
            if (draw) draw->key = (choice++)->key;
    }
    const std::vector<Key> keys = scene::distinct_keys(report.keys);
    Outcome outcome;
    outcome.diagnostics = scene.warnings;
    if (options.keys) {
        for (const Key& key : keys) outcome.output += key_text(family, key) + "\n";
        return outcome;
    }
    // Only composing tells which keys are the same program.
    GOBO_TRY(const Composition composition, compose_keys(loaded, keys));
    std::set<StageNumbers> programs;
    for (const Permutation& permutation : composition.permutations) programs.insert(permutation.stages);
    report.distinct_programs = programs.size();
    report.compiled_stages = composition.stages.size();
    append(
        outcome.diagnostics,
        validate(family, composition,
                 {.jobs = world.jobs(), .child_processes = !world.options.in_process, .cache = world.cache})
            .diagnostics);
    outcome.output = options.json ? scene_json(report) : scene_text(report);
    outcome.summary = join(needed.notes, "\n");
    return outcome;
}

}  // namespace

Command scene_command() {
    const auto options = std::make_shared<SceneOptions>();
    return {
        {"scene", "What each draw of a glTF scene needs, and the keys"},
        {{"SCENE", "", "A .gltf or .glb file", &options->scene, kRequired},
         family_argument(options->family),
         {"--bucket-lights", "0,1,2,...", "Round light counts up to one of these", &options->bucket_lights},
         {"--camera", "N|all|none",
          "From where the scene is seen: a camera's number in the file, all cameras (the default), or none: "
          "from anywhere",
          &options->camera},
         {"--light-threshold", "X", "The greatest radiance that a light left out may send",
          &options->thresholds.light, kNotNegative},
         {"--fog-threshold", "X", "The greatest part of the light that fog left out may hide",
          &options->thresholds.fog, kNotNegative},
         {"--keys", "", "Print the keys only, one a line, as --keys-from reads them", &options->keys},
         {"--json", "", "Print JSON", &options->json},
         dialect_option(options->dialect)},
        {budget_options(options->budget)},
        "  gobo scene room.gltf\n"
        "  gobo scene room.glb lit --bucket-lights 0,1,2,4,8\n"
        "  gobo scene room.gltf --max-error 0.01 --keys\n"
        "  gobo scene room.gltf game.toml --keys | gobo build game.toml --keys-from - -o generated\n"
        "  gobo build lit --scene room.gltf -o generated",
        [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
