#include <algorithm>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/study/report_parts.hpp"

namespace gobo::study {
namespace {

/// The rank correlation that a weighted cost should reach to stand for time.
constexpr double kGoodCorrelation = 0.9;

const Timing* any_timing(const Study& study) {
    for (const EffectsResult& effects : study.effects)
        for (const KeyResult& key : effects.keys)
            if (key.timing) return &*key.timing;
    return nullptr;
}

std::string percent(double share) {
    return fmt::format("{:.1f} %", 100 * share);
}

/// One row for each combination: its control, and how many keys cannot be told from the most accurate one.
std::string control_table(const ReportInput& input, const std::string& renderer) {
    std::vector<std::vector<std::string>> rows;
    for (const EffectsResult& effects : input.study.effects) {
        if (!effects.control) continue;
        std::size_t timed = 0;
        std::size_t alike = 0;
        const Timing& accurate = *effects.keys.front().timing;
        for (const KeyResult& key : effects.keys) {
            if (!key.timing || &key == &effects.keys.front()) continue;
            ++timed;
            if (ranked_slopes(*key.timing).fragment.overlaps(ranked_slopes(accurate).fragment)) ++alike;
        }
        const bool holds = ranked_control(*effects.control, renderer) <= kLargestControl;
        rows.push_back({key_text(input.family, effects.effects), percent(effects.control->elapsed),
                        percent(effects.control->processor),
                        holds ? fmt::format("{} of {} show no measurable difference from the most accurate",
                                            alike, timed)
                              : "off by more than 2 %: nothing is ranked by time"});
    }
    return html_table({"effects", "A/A, elapsed", "A/A, processor", "fragments"}, rows);
}

std::string why_not(bool of_vertices) {
    if (of_vertices)
        return ", below 0.9: where light is computed per fragment, vertex stages are all but the same, and "
               "what a "
               "vertex costs besides its operations (fetching, clipping, setting up) outweighs them; ranks "
               "among "
               "such equals are chance. Shading rates, whose vertex stages do differ, are told apart";
    return ", below 0.9: the kinds that are counted do not tell apart what the renderer's compiler merges or "
           "leaves out, or the machine was too busy";
}

std::string correlation_text(const ReportInput& input, bool of_vertices) {
    const CostAndTime points = cost_against_time(input.study, input.weights, of_vertices);
    const bool by_processor = draws_in_calling_thread(any_timing(input.study)->renderer);
    std::string text = time_chart(points, of_vertices, by_processor).svg();
    text += fmt::format("<p>Rank correlation of cost and time of a {}: {:.2f} over {} permutations{}.</p>\n",
                        of_vertices ? "vertex" : "fragment", points.correlation, points.cost.size(),
                        points.correlation >= kGoodCorrelation ? "" : why_not(of_vertices));
    return text;
}

}  // namespace

std::string time_section(const ReportInput& input) {
    const Timing* timing = any_timing(input.study);
    if (timing == nullptr)
        return "<p>This study has no times: it was made with --quick or --no-time. Costs are counts of "
               "executed "
               "operations, which repeat exactly.</p>\n";
    std::string text = fmt::format(
        "<p>Measured on {}{}. A permutation's time is the slope between two sizes (fragments) or two "
        "tessellations (vertices): median and middle half of {} interleaved rounds, each in another order. A "
        "second "
        "copy of the most accurate program is the A/A control. Ranges that overlap are no measurable "
        "difference.</p>\n",
        escaped(timing->renderer), input.machine.empty() ? "" : ", " + escaped(input.machine),
        timing->rounds);
    text += control_table(input, timing->renderer);
    return text + correlation_text(input, false) + correlation_text(input, true);
}

std::string method_section(const ReportInput& input) {
    std::string text = fmt::format(
        "<p>Made by <code>{}</code>; every figure is a row of study.csv or curves.csv beside this "
        "page.</p>\n<ul>\n",
        escaped(input.command));
    text += fmt::format(
        "<li>Errors: each permutation evaluated in fp32 and fp64 at the visible points of {} pictures of {} "
        "x {} "
        "pixels, against the oracle's double precision where it knows the model, else against the most "
        "accurate "
        "permutation in fp64. Points decided within a rounding of a discontinuity are counted, not "
        "judged.</li>\n",
        input.study.scenes.size(), kSampleWidth, kSampleHeight);
    text +=
        "<li>Three causes: rounding (fp32 against fp64 of the same permutation), approximation (fp64 at full "
        "shading rate against the reference), shading rate (fp64 against fp64 at full rate).</li>\n";
    text += fmt::format(
        "<li>Cost: executed operations by kind, times weights measured on {}; one unit is an addition ({} ns "
        "there). "
        "The vertices' work is spread over the fragments of a picture of {} x {}.</li>\n</ul>\n",
        escaped(input.weights.renderer), short_number(input.weights.nanoseconds), kFullWidth, kFullHeight);
    std::vector<std::vector<std::string>> rows;
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        if (input.weights.by_kind[kind] > 0)
            rows.push_back(
                {std::string(evaluate::kKindNames[kind]), short_number(input.weights.by_kind[kind])});
    return text + html_table({"operation", "weight"}, rows);
}

}  // namespace gobo::study
