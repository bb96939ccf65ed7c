#include "lab/study/study.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/study/parallel_results.hpp"
#include "lab/study/qualities.hpp"

namespace gobo::study {
namespace {

/// What a screening forgives: costs and errors of so few points are rough. It gets stricter until few
/// qualities are left.
struct Slack {
    double cost;
    double error;
};
constexpr std::array<Slack, 4> kSlacks = {{{1.1, 1.5}, {1.05, 1.25}, {1.02, 1.1}, {1, 1}}};

/// The worst error over the scenes, and the cost over all of them, up to a factor.
Result<Priced> price(const std::vector<ScenePoints>& scenes, const Variant& variant, const Weights& weights) {
    Priced priced;
    for (const ScenePoints& points : scenes) {
        Measurement rough;
        static_cast<PointCounts&>(rough) = points;
        GOBO_TRY(const Colors colors, shade_points<float>(points, variant, &rough.work));
        priced.error = std::max(priced.error, error_between(points, colors, reference_colors(points)).max);
        const Costs costs = costs_of(rough, weights);
        priced.cost += costs.fragment;
        priced.cost += costs.vertex * 0.05;  // a mesh has a vertex for some twenty pixels
    }
    return priced;
}

/// Those of the keys, of which the first is the most accurate, that lie near the front on a few points.
Result<std::vector<Key>> screen(const Subject& subject, const std::vector<Key>& keys, const Key& accurate,
                                const std::vector<DrawnScene>& scenes, const Weights& weights) {
    constexpr std::size_t kScreenPoints = 96;  // of each scene
    constexpr std::size_t kMostMeasured = 192;
    GOBO_TRY(const Variants variants, load_variants(subject, keys));
    const auto points_of = [&](std::size_t i) -> Result<ScenePoints> {
        GOBO_TRY(const ScenePoints points, find_points(subject.family, variants.at(accurate), scenes[i]));
        return thinned(points, kScreenPoints);
    };
    GOBO_TRY(const auto points, parallel_results(subject.jobs, scenes.size(), points_of));
    GOBO_TRY(const std::vector<Priced> priced,
             parallel_results(subject.jobs, keys.size(),
                              [&](std::size_t i) { return price(points, variants.at(keys[i]), weights); }));
    std::vector<Key> kept;
    for (const Slack& slack : kSlacks) {
        kept.clear();
        const std::vector<bool> near = near_front(priced, slack.cost, slack.error);
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (near[i]) kept.push_back(keys[i]);
        if (kept.size() <= kMostMeasured) break;
    }
    return kept;
}

/// The qualities that are measured of a combination of effects.
struct Candidates {
    std::vector<Key> keys;  ///< the most accurate one first, then every single choice, then the others
    std::size_t considered = 0;
};

Result<Candidates> find_candidates(const Subject& subject, const Key& effects,
                                   const std::vector<DrawnScene>& scenes, const Weights& weights) {
    constexpr std::size_t kMeasuredWithoutScreening = 128;
    constexpr std::size_t kMostScreened = 16384;  // of more, only single choices are measured
    const Key accurate = most_accurate(subject.family, effects);
    Candidates candidates;
    candidates.keys = {accurate};
    for (const Choice& choice : single_choices(subject.family, effects))
        candidates.keys.push_back(choice.key);
    std::vector<Key> all = all_qualities(subject.family, effects, kMostScreened);
    std::set<Key> considered(all.begin(), all.end());
    considered.insert(candidates.keys.begin(),
                      candidates.keys.end());  // excluded values are single choices only
    candidates.considered = considered.size();
    if (all.size() > kMeasuredWithoutScreening) {
        GOBO_TRY(all, screen(subject, all, accurate, scenes, weights));
    }
    std::set<Key> seen(candidates.keys.begin(), candidates.keys.end());
    for (Key& key : all)
        if (seen.insert(key).second) candidates.keys.push_back(std::move(key));
    return candidates;
}

/// The key with the features that say where light is computed at their most accurate values, canonical.
Key at_full_rate(const Family& family, const StudyPlan& plan, const Key& key) {
    Key full = key;
    for (const std::string& name : plan.rate)
        if (const auto feature = family.index_of(name))
            full[static_cast<std::size_t>(*feature)] =
                most_accurate_value(family.features[static_cast<std::size_t>(*feature)]);
    // A feature that the coarser rate left without effect stands at its default there, which need not be the
    // most accurate value.
    const Key accurate = most_accurate(family, key);
    const Key coarse = canonical(family, key, "450");
    for (const int feature : quality_features(family)) {
        const auto i = static_cast<std::size_t>(feature);
        Key accurate_here = coarse;
        accurate_here[i] = accurate[i];
        if (canonical(family, accurate_here, "450") == coarse) full[i] = accurate[i];
    }
    return canonical(family, std::move(full), "450");
}

Result<EffectsResult> measure_on(const Subject& subject, const StudyPlan& plan, const Key& effects,
                                 const std::vector<Key>& keys, const std::vector<DrawnScene>& scenes,
                                 Journal& journal) {
    std::vector<Key> full_rate;
    for (const Key& key : keys) full_rate.push_back(at_full_rate(subject.family, plan, key));
    std::vector<Key> all = keys;
    all.insert(all.end(), full_rate.begin(), full_rate.end());
    GOBO_TRY(const Variants variants, load_variants(subject, all));
    const Variant& accurate = variants.at(keys.front());
    EffectsResult result;
    result.effects = effects;
    for (const Key& key : keys) result.keys.push_back({key, std::vector<Measurement>(scenes.size()), {}, {}});
    for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
        const auto identity = [&](std::size_t i) {
            return identity_of_text(fmt::format("errors 2 {} {:x} {:x} {:x}", scenes[scene].identity,
                                                variants.at(keys[i]).hash, variants.at(full_rate[i]).hash,
                                                accurate.hash));
        };
        std::vector<std::size_t> missing;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (const auto known = journal.find<Measurement>(identity(i)))
                result.keys[i].scenes[scene] = *known;
            else
                missing.push_back(i);
        }
        if (missing.empty()) continue;
        GOBO_TRY(const ScenePoints points, find_points(subject.family, accurate, scenes[scene]));
        const auto measure_one = [&](std::size_t i) -> Result<Measurement> {
            GOBO_TRY(const Measurement measured,
                     measure(points, variants.at(keys[i]), variants.at(full_rate[i])));
            GOBO_TRY_DO(journal.add(identity(i), measured));
            return measured;
        };
        GOBO_TRY(const auto measured, parallel_results(subject.jobs, missing.size(), [&](std::size_t i) {
                     return measure_one(missing[i]);
                 }));
        for (std::size_t i = 0; i < missing.size(); ++i) result.keys[missing[i]].scenes[scene] = measured[i];
    }
    return result;
}

/// A feature at each of its values along scenes, each with its number: what a curve shows.
struct Line {
    std::string feature;
    std::string over;
    std::string effects;
    std::vector<std::pair<double, DrawnScene>> stops;
    std::vector<std::pair<std::string, Key>> values = {};  ///< the most accurate first
};

Line tessellation_line(const Family& family, const StudyPlan& plan, const std::string& feature) {
    // The plan's last quick effects show most.
    Line line{feature, "slices", plan.quick.back(), {}};
    for (const int slices : {8, 16, 32, 64, 128, 256})
        line.stops.emplace_back(slices, sphere_scene(family, slices, kSampleWidth, kSampleHeight));
    return line;
}

Line line_of(const Family& family, const StudyCurve& curve) {
    Line line{curve.feature, curve.over, curve.effects, {}};
    for (const double number : curve.numbers) {
        // Fine, so that the highlight is seen from many directions; the same points for every number.
        DrawnScene scene = sphere_scene(family, 128, kSampleWidth, kSampleHeight);
        scene.add_values({{curve.over, {}, {number}, {}}});
        scene.identity += fmt::format(" {}={}", curve.over, number);
        line.stops.emplace_back(number, std::move(scene));
    }
    return line;
}

/// The most accurate key with one feature at each of its values.
void add_values(const Family& family, Line& line) {
    const Key effects = parse_key(family, line.effects).value();
    const int index = family.index_of(line.feature).value();
    const Feature& feature = family.features[static_cast<std::size_t>(index)];
    const auto add = [&](int value, Key key) {
        line.values.emplace_back(feature.values[static_cast<std::size_t>(value)], std::move(key));
    };
    add(most_accurate_value(feature), most_accurate(family, effects));
    for (const Choice& choice : single_choices(family, effects))
        if (choice.feature == index) add(choice.value, choice.key);
}

Result<std::vector<CurvePoint>> measure_stop(const Family& family, const Variants& variants, const Line& line,
                                             const std::pair<double, DrawnScene>& stop, Journal& journal) {
    std::vector<CurvePoint> curve;
    const Variant& accurate = variants.at(line.values.front().second);
    std::optional<ScenePoints> points;
    for (const auto& [value, key] : line.values) {
        const Variant& variant = variants.at(key);
        const std::string identity = identity_of_text(
            fmt::format("curve 1 {} {:x} {:x}", stop.second.identity, variant.hash, accurate.hash));
        auto errors = journal.find<CurveErrors>(identity);
        if (!errors) {
            if (!points) {
                GOBO_TRY(points, find_points(family, accurate, stop.second));
            }
            GOBO_TRY(const Measurement measured, measure(*points, variant, variant));
            errors = {measured.approximation, measured.total};
            GOBO_TRY_DO(journal.add(identity, *errors));
        }
        curve.push_back(
            {line.feature, value, line.over, stop.first, line.effects, (*errors)[0], (*errors)[1]});
    }
    return curve;
}

Result<std::vector<CurvePoint>> measure_curves(const Subject& subject, const StudyPlan& plan, bool quick,
                                               Journal& journal) {
    const Family& family = subject.family;
    std::vector<Line> lines;
    for (const std::string& feature : plan.rate) lines.push_back(tessellation_line(family, plan, feature));
    if (!quick)
        for (const StudyCurve& curve : plan.curves) lines.push_back(line_of(family, curve));
    std::vector<Key> keys;
    std::vector<std::pair<const Line*, std::size_t>> work;  // a line, and the number of its stop
    for (Line& line : lines) {
        add_values(family, line);
        for (const auto& [value, key] : line.values) keys.push_back(key);
        for (std::size_t stop = 0; stop < line.stops.size(); ++stop) work.emplace_back(&line, stop);
    }
    std::vector<CurvePoint> curves;
    if (work.empty()) return curves;
    GOBO_TRY(const Variants variants, load_variants(subject, keys));
    GOBO_TRY(const auto measured, parallel_results(subject.jobs, work.size(), [&](std::size_t i) {
                 const auto& [line, stop] = work[i];
                 return measure_stop(family, variants, *line, line->stops[stop], journal);
             }));
    for (const auto& points : measured) curves.insert(curves.end(), points.begin(), points.end());
    return curves;
}

Result<ChangeResult> measure_change(const Subject& subject, const DrawnScene& scene,
                                    const StudyChange& change) {
    const Family& family = subject.family;
    const Key from = most_accurate(family, parse_key(family, change.from).value());
    const Key to = most_accurate(family, parse_key(family, change.to).value());
    GOBO_TRY(const Variants variants, load_variants(subject, {from, to}));
    DrawnScene first = scene;
    first.add_values(change.from_values);
    GOBO_TRY(ScenePoints points, find_points(family, variants.at(from), std::move(first)));
    ChangeResult result;
    result.change = change;
    const Colors reference = reference_colors(points);
    for (const auto& colors : reference)
        for (const Color& color : colors)
            result.largest = std::max(result.largest, *std::max_element(color.begin(), color.end()));
    points.scene = scene;
    points.scene.add_values(change.to_values);
    GOBO_TRY(const Colors second, shade_points<double>(points, variants.at(to)));
    result.difference = error_between(points, second, reference);
    return result;
}

/// The indices of the keys to time: the most accurate one, the single choices, the front.
std::vector<std::size_t> timed_keys(const Family& family, const EffectsResult& effects,
                                    const Weights& weights) {
    constexpr std::size_t kMostTimed = 40;
    const std::size_t singles = single_choices(family, effects.effects).size();
    const std::vector<StudiedKey> keys = studied_keys(effects, weights);
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < keys.size() && indices.size() < kMostTimed; ++i)
        if (i <= singles || keys[i].on_front) indices.push_back(i);
    return indices;
}

Result<TimedGroup> time_group(const Subject& subject, const Context& context, const TimeOptions& options,
                              Journal& journal, const StudyPlan& plan, const std::vector<Key>& keys) {
    GOBO_TRY(const Variants variants, load_variants(subject, keys));
    GOBO_TRY(const DrawnScene scene, draw_scene(subject.shipped, subject.family, plan.scenes.front()));
    // GPUs are timed by clocks of their own since the second version.
    std::string text =
        fmt::format("times {} {} {} {} {}", draws_in_calling_thread(context.renderer()) ? 1 : 2,
                    options.computer, context.renderer(), options.rounds, scene.identity);
    for (const Key& key : keys) text += fmt::format(" {:x}", variants.at(key).hash);
    const std::string identity = identity_of_text(text);
    if (auto known = journal.find<TimedGroup>(identity); known && known->timings.size() == keys.size())
        return std::move(*known);
    GOBO_TRY(TimedGroup group, time_variants(context, subject.family, variants, keys, scene, options.rounds));
    GOBO_TRY_DO(journal.add(identity, group));
    return group;
}

}  // namespace

Result<Study> run_study(const Subject& subject, const StudyOptions& options, Journal& journal) {
    const Family& family = subject.family;
    Study study;
    study.plan = options.plan;
    GOBO_TRY(const auto scenes, draw_scenes(subject.shipped, family, study.plan));
    for (const DrawnScene& scene : scenes) study.scenes.push_back(scene.name);
    const std::vector<std::string>& wanted = !options.effects.empty() ? options.effects
                                             : options.quick          ? study.plan.quick
                                                                      : study.plan.effects;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        options.progress(wanted[i], i, wanted.size());
        GOBO_TRY(const Key key, parse_key(family, wanted[i]));
        const Key effects = effects_of(family, key);
        GOBO_TRY(const Candidates candidates, find_candidates(subject, effects, scenes, options.weights));
        GOBO_TRY(EffectsResult result,
                 measure_on(subject, study.plan, effects, candidates.keys, scenes, journal));
        result.considered = candidates.considered;
        study.effects.push_back(std::move(result));
    }
    options.progress("curves", wanted.size(), wanted.size());
    GOBO_TRY(study.curves, measure_curves(subject, study.plan, options.quick, journal));
    for (const StudyChange& change : study.plan.changes) {
        GOBO_TRY(ChangeResult result, measure_change(subject, scenes.front(), change));
        study.changes.push_back(std::move(result));
    }
    return study;
}

Result<EffectsResult> measure_keys(const Subject& subject, const Key& effects, const std::vector<Key>& keys,
                                   const StudyPlan& plan, Journal& journal) {
    GOBO_TRY(const auto scenes, draw_scenes(subject.shipped, subject.family, plan));
    return measure_on(subject, plan, effects, keys, scenes, journal);
}

std::vector<StudiedKey> studied_keys(const EffectsResult& result, const Weights& weights) {
    std::vector<StudiedKey> keys;
    std::vector<Priced> points;
    for (const KeyResult& one : result.keys) {
        StudiedKey& studied = keys.emplace_back();
        studied.key = one.key;
        for (const Measurement& measured : one.scenes) {
            studied.error = std::max(studied.error, measured.total.max);
            studied.cost += costs_of(measured, weights).total / static_cast<double>(one.scenes.size());
        }
        points.push_back({studied.cost, studied.error});
    }
    const auto by = dominators(points);
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i].on_front = !by[i];
    return keys;
}

std::vector<Key> front_qualities(const Family& family, const StudiedEffects& studied, const Key& effects) {
    std::vector<Key> keys = {most_accurate(family, effects)};
    std::set<Key> seen(keys.begin(), keys.end());
    for (const auto& [of, candidates] : studied) {
        for (const StudiedKey& candidate : candidates) {
            Key key = with_quality_of(family, effects, candidate.key);
            if (candidate.on_front && is_valid(family, key) && seen.insert(key).second)
                keys.push_back(std::move(key));
        }
    }
    return keys;
}

Result<void> add_times(const Subject& subject, const Context& context, const Weights& weights,
                       const TimeOptions& options, Journal& journal, Study& study) {
    for (std::size_t e = 0; e < study.effects.size(); ++e) {
        EffectsResult& effects = study.effects[e];
        options.progress("timing " + key_text(subject.family, effects.effects), e, study.effects.size());
        const std::vector<std::size_t> indices = timed_keys(subject.family, effects, weights);
        std::vector<Key> keys;
        for (const std::size_t i : indices) keys.push_back(effects.keys[i].key);
        GOBO_TRY(const TimedGroup group, time_group(subject, context, options, journal, study.plan, keys));
        for (std::size_t i = 0; i < indices.size(); ++i) effects.keys[indices[i]].timing = group.timings[i];
        effects.control = group.control;
    }
    options.progress("", study.effects.size(), study.effects.size());
    return {};
}

Result<void> add_instructions(const Subject& subject, const DrawCommand& command, const TimeOptions& options,
                              Journal& journal, Study& study) {
    EffectsResult& effects = study.effects.back();
    for (std::size_t i = 0; i < effects.keys.size(); ++i) {
        KeyResult& result = effects.keys[i];
        if (!result.timing) continue;
        const std::string key = key_text(subject.family, result.key);
        options.progress("instructions of " + key, i, effects.keys.size());
        GOBO_TRY(const Variants variants, load_variants(subject, {result.key}));
        const std::string identity =
            identity_of_text(fmt::format("instructions 1 {} {} {:x}", options.computer,
                                         result.timing->renderer, variants.all.front().hash));
        result.instructions = journal.find<double>(identity);
        if (result.instructions) continue;
        GOBO_TRY(result.instructions, count_instructions(command, key));
        GOBO_TRY_DO(journal.add(identity, *result.instructions));
    }
    options.progress("", effects.keys.size(), effects.keys.size());
    return {};
}

CostAndTime cost_against_time(const Study& study, const Weights& weights, bool of_vertices) {
    CostAndTime result;
    for (const EffectsResult& effects : study.effects) {
        for (const KeyResult& key : effects.keys) {
            if (!key.timing) continue;
            if (effects.control && effects.control->ranked(key.timing->renderer) > kLargestControl) continue;
            const Costs costs = costs_of(key.scenes.front(), weights);
            const Slopes& slopes = key.timing->ranked();
            result.cost.push_back(of_vertices ? costs.vertex : costs.fragment);
            result.nanoseconds.push_back(of_vertices ? slopes.vertex.median : slopes.fragment.median);
        }
    }
    result.correlation = rank_correlation(result.cost, result.nanoseconds);
    return result;
}

std::string times_summary(const Study& study, const Weights& weights) {
    Control worst;
    std::size_t timed = 0;
    std::string renderer;
    for (const EffectsResult& effects : study.effects) {
        if (!effects.control) continue;
        for (const KeyResult& key : effects.keys) {
            if (!key.timing) continue;
            ++timed;
            renderer = key.timing->renderer;
        }
        worst.elapsed = std::max(worst.elapsed, effects.control->elapsed);
        worst.processor = std::max(worst.processor, effects.control->processor);
    }
    if (timed == 0) return "";
    const CostAndTime fragments = cost_against_time(study, weights, false);
    const CostAndTime vertices = cost_against_time(study, weights, true);
    std::string text = fmt::format(
        "A/A control, worst: elapsed {:.1f} %, processor {:.1f} %; {} time counts\n", 100 * worst.elapsed,
        100 * worst.processor, draws_in_calling_thread(renderer) ? "processor" : "elapsed");
    const std::size_t ranked = fragments.cost.size();
    if (ranked < timed)
        text += fmt::format(
            "{} of {} permutations are not ranked by time: their control is off by more than {:.0f} %\n",
            timed - ranked, timed, 100 * kLargestControl);
    if (ranked > 0)
        text += fmt::format(
            "rank correlation of cost and time: fragments {:.2f}, vertices {:.2f}, over {} permutations\n",
            fragments.correlation, vertices.correlation, ranked);
    return text;
}

}  // namespace gobo::study
