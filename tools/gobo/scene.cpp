// gobo scene: which effects each draw of a scene needs, the keys, and how few they are.
#include <charconv>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "gobo/budget.hpp"
#include "gobo/commands.hpp"
#include "gobo/scene_report.hpp"
#include "scene/read_scene.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct SceneOptions {
    CommonOptions common;
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

Result<scene::EyePlace> place_eye(const scene::Scene& scene, const std::string& camera) {
    if (camera == "all") return scene::eye_of_cameras(scene);
    if (camera == "none") return scene::EyePlace();
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(camera.data(), camera.data() + camera.size(), number);
    if (error == std::errc() && end == camera.data() + camera.size()) {
        if (const auto eye = scene::eye_of_cameras(scene, number)) return eye;
    }
    return fail(Fault::usage,
                fmt::format("--camera: no node of '{}' holds a camera '{}'", scene.path, camera),
                fmt::format("the file has {} cameras, numbered from 0; 'all' and 'none' are known too",
                            scene.cameras.size()));
}

/// Composes and compiles the keys: only that tells which of them are the same program.
Result<Diagnostics> compile(const CommonOptions& options, const LoadedFamily& family, Dialect dialect,
                            SceneReport& report) {
    const Result<Composition> composition =
        compose(family.family, scene::distinct_keys(report.keys), family.search, dialect);
    if (!composition) return tl::unexpected(composition.error());
    ValidateOptions validate_options;
    validate_options.jobs = options.jobs;
    Diagnostics diagnostics = validate(family.family, *composition, validate_options).diagnostics;
    std::set<std::pair<int, int>> programs;
    for (const Permutation& permutation : composition->permutations)
        programs.emplace(permutation.vertex, permutation.fragment);
    report.distinct_programs = programs.size();
    report.compiled_stages = composition->stages.size();
    return diagnostics;
}

Result<SceneReport> make_report(const Family& family, const std::vector<scene::Draw>& draws,
                                const scene::Buckets& buckets, std::string_view dialect) {
    SceneReport report{family, draws, {}, {}, buckets, {}, 0, 0};
    auto keys = scene::keys_for_draws(family, draws, buckets, dialect);
    if (!keys) return tl::unexpected(keys.error());
    auto rows = scene::compare_bucketings(family, draws, buckets, dialect);
    if (!rows) return tl::unexpected(rows.error());
    const auto funnel = scene::measure_funnel(family, draws, buckets, dialect);
    if (!funnel) return tl::unexpected(funnel.error());
    report.keys = std::move(*keys);
    report.bucketings = std::move(*rows);
    report.funnel = *funnel;
    return report;
}

/// The draws' keys become those that the budget chooses for their effects.
Result<void> apply_budget(const SceneOptions& options, const World& world, LoadedFamily& family,
                          std::string_view dialect, SceneReport& report) {
    std::vector<Key> keys;
    for (const auto& draw : report.keys)
        if (draw) keys.push_back(draw->key);
    const auto choices = choose_qualities(world, family, options.budget, keys, dialect, options.common.jobs);
    if (!choices) return tl::unexpected(choices.error());
    std::size_t next = 0;
    for (auto& draw : report.keys)
        if (draw) draw->key = (*choices)[next++].key;
    return {};
}

Outcome run(const SceneOptions& options, const World& world) {
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return failed(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const Result<scene::Buckets> buckets = scene::parse_buckets(options.bucket_lights);
    if (!buckets) return failed(buckets.error());
    const Result<scene::Scene> scene = scene::read_scene(world.disk, options.scene);
    if (!scene) return failed(scene.error());
    const Result<scene::EyePlace> eye = place_eye(*scene, options.camera);
    if (!eye) return failed(eye.error());
    const auto draws = scene::required_effects(*scene, *eye, options.thresholds);
    Result<SceneReport> report = make_report(family->family, draws, *buckets, name_of(*dialect));
    if (!report) return failed(report.error());
    if (options.budget.is_set())
        if (auto applied = apply_budget(options, world, *family, name_of(*dialect), *report); !applied)
            return failed(applied.error());
    Outcome outcome;
    if (options.keys) {
        for (const Key& key : scene::distinct_keys(report->keys))
            outcome.output += key_text(family->family, key) + "\n";
        return outcome;
    }
    Result<Diagnostics> diagnostics = compile(options.common, *family, *dialect, *report);
    if (!diagnostics) return failed(diagnostics.error());
    outcome.diagnostics = std::move(*diagnostics);
    outcome.output = options.json ? scene_json(*report) : scene_text(*report);
    return outcome;
}

}  // namespace

Command scene_command(CLI::App& gobo) {
    auto options = std::make_shared<SceneOptions>();
    CLI::App* app = gobo.add_subcommand("scene", "What each draw of a glTF scene needs, and the keys");
    app->add_option("SCENE", options->scene, "A .gltf or .glb file")->required();
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file; by default lit");
    app->add_option("--bucket-lights", options->bucket_lights, "Round light counts up to one of these")
        ->type_name("0,1,2,...");
    app->add_option(
           "--camera", options->camera,
           "From where the scene is seen: a camera's number in the file, all of them (the default), or none: "
           "then from anywhere")
        ->type_name("N|all|none");
    app->add_option("--light-threshold", options->thresholds.light,
                    "The greatest radiance that a light left out may send; by default 1/512")
        ->type_name("X")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--fog-threshold", options->thresholds.fog,
                    "The greatest share that fog left out may hide; by default 1/512")
        ->type_name("X")
        ->check(CLI::NonNegativeNumber);
    add_budget_options(*app, options->budget);
    app->add_flag("--keys", options->keys, "Print the keys only, one a line, as --keys-from reads them");
    app->add_flag("--json", options->json, "Print JSON");
    add_dialect_option(*app, options->dialect);
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo scene room.gltf\n"
        "  gobo scene room.glb lit --bucket-lights 0,1,2,4,8\n"
        "  gobo scene room.gltf --max-error 0.01 --keys\n"
        "  gobo scene room.gltf game.toml --keys | gobo build game.toml --keys-from - -o generated\n"
        "  gobo build lit --scene room.gltf -o generated");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
