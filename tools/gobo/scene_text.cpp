#include <fmt/format.h>

#include "family/key.hpp"
#include "gobo/scene_report.hpp"

namespace gobo {
namespace {

std::string draw_text(const SceneReport& report, std::size_t index) {
    const scene::Draw& draw = report.draws[index];
    if (!report.keys[index]) return fmt::format("{}: out, {}\n", draw.name, draw.excluded);
    const scene::DrawKey& key = *report.keys[index];
    std::string text = fmt::format("{}: {}\n", draw.name, key_text(report.family, key.key));
    for (const scene::Effect& effect : draw.effects)
        text += fmt::format("  {}: {}, {}\n", effect.name, effect.is_in ? "in" : "out", effect.reason);
    for (const std::string& missing : key.missing) text += fmt::format("  ! {}\n", missing);
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
        funnel.full_product, funnel.valid, funnel.needed, funnel.draws, funnel.draws == 1 ? "" : "s",
        funnel.bucketed, scene::buckets_text(report.buckets), report.distinct_programs,
        report.compiled_stages);
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

}  // namespace

std::string scene_text(const SceneReport& report) {
    std::string text;
    for (std::size_t i = 0; i < report.draws.size(); ++i) text += draw_text(report, i) + "\n";
    text += "keys\n";
    for (const Key& key : scene::distinct_keys(report.keys))
        text += fmt::format("  {}\n", key_text(report.family, key));
    return text + "\n" + funnel_text(report) + "\n" + bucketings_text(report);
}

}  // namespace gobo
