#include "lab/commands/study_files.hpp"

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/study/choices.hpp"
#include "lab/study/study.hpp"

namespace gobo {
namespace {

std::string front_text(const Family& family, const study::EffectsResult& effects,
                       const study::Weights& weights) {
    const std::vector<StudiedKey> keys = study::studied_keys(effects, weights);
    std::size_t front = 0;
    const StudiedKey* cheapest = nullptr;
    const StudiedKey* best = nullptr;
    for (const StudiedKey& key : keys) {
        if (!key.on_front) continue;
        ++front;
        if (cheapest == nullptr || key.cost < cheapest->cost) cheapest = &key;
        if (best == nullptr || key.error < best->error) best = &key;
    }
    return fmt::format("{}: {} of {} measured, {} on the front, cost {} at error {} to cost {} at error {}\n",
                       key_text(family, effects.effects), keys.size(), effects.considered, front,
                       short_number(best->cost), short_number(best->error), short_number(cheapest->cost),
                       short_number(cheapest->error));
}

std::string time_text(const study::Study& study, const study::Weights& weights) {
    double elapsed = 0;
    double processor = 0;
    bool is_timed = false;
    for (const study::EffectsResult& effects : study.effects) {
        if (!effects.control) continue;
        is_timed = true;
        elapsed = std::max(elapsed, effects.control->elapsed);
        processor = std::max(processor, effects.control->processor);
    }
    if (!is_timed) return "";
    const auto fragments = study::cost_against_time(study, weights, false);
    const auto vertices = study::cost_against_time(study, weights, true);
    return fmt::format(
        "A/A control, worst: elapsed {:.1f} %, processor {:.1f} %\n"
        "rank correlation of cost and time: fragments {:.2f}, vertices {:.2f}, over {} permutations\n",
        100 * elapsed, 100 * processor, fragments.correlation, vertices.correlation, fragments.cost.size());
}

}  // namespace

Result<study::Weights> load_weights(const World& world, const std::string& path) {
    const std::string shipped = "data/study/weights.csv";
    const Result<std::string> text = path.empty() ? world.shipped.read(shipped) : read_input(world, path);
    if (!text) return tl::unexpected(text.error());
    const auto weights = study::read_weights(*text, path.empty() ? shipped : path);
    if (!weights) return tl::unexpected(weights.error());
    return weights->front();
}

Result<study::StudyPlan> load_plan(const World& world, const Family& family, const std::string& path) {
    const std::string shipped = fmt::format("data/study/{}.toml", family.name);
    if (path.empty() && !world.shipped.is_file(shipped)) return study::default_plan(family);
    const Result<std::string> text = path.empty() ? world.shipped.read(shipped) : read_input(world, path);
    if (!text) return tl::unexpected(text.error());
    return study::read_plan(*text, path.empty() ? shipped : path, family);
}

std::string machine_name(const FileSystem& disk) {
    const Result<std::string> text = disk.read("/proc/cpuinfo");
    if (!text) return "";
    const std::size_t at = text->find("model name");
    if (at == std::string::npos) return "";
    const std::size_t colon = text->find(':', at);
    return std::string(trim(text->substr(colon + 1, text->find('\n', at) - colon - 1)));
}

std::string study_summary(const Family& family, const study::Study& study, const study::Weights& weights) {
    std::string text;
    for (const study::EffectsResult& effects : study.effects) text += front_text(family, effects, weights);
    text += time_text(study, weights);
    for (const study::ChoiceSummary& choice : study::summarise_choices(family, study, weights))
        if (!choice.dominated_by.empty())
            text += fmt::format("{}={} is dominated everywhere by {}\n", choice.feature, choice.value,
                                choice.dominated_by);
    return text;
}

}  // namespace gobo
