#include "lab/study/study.hpp"

#include <atomic>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "family/key.hpp"
#include "lab/study/candidates.hpp"
#include "lab/study/curves.hpp"
#include "lab/study/measurement_json.hpp"
#include "budget/qualities.hpp"
#include "lab/verify/parallel.hpp"

namespace gobo::study {
namespace {

Result<std::vector<DrawnScene>> draw_scenes(const FileSystem& shipped, const Family& family,
                                            const StudyPlan& plan) {
    std::vector<DrawnScene> scenes;
    for (const StudyScene& scene : plan.scenes) {
        Result<DrawnScene> drawn = draw_scene(shipped, family, scene);
        if (!drawn) return tl::unexpected(drawn.error());
        scenes.push_back(std::move(*drawn));
    }
    return scenes;
}

/// Measures the keys of one combination of effects.
class EffectsStudy {
  public:
    EffectsStudy(const Family& family, const StudyPlan& plan, const Variants& variants,
                 const std::vector<DrawnScene>& scenes, Journal& journal, const StudyOptions& options)
        : family_(family),
          plan_(plan),
          variants_(variants),
          scenes_(scenes),
          journal_(journal),
          options_(options) {}

    Result<EffectsResult> run(const Key& effects, const std::vector<Key>& keys) {
        EffectsResult result;
        result.effects = effects;
        for (const Key& key : keys)
            result.keys.push_back({key, std::vector<Measurement>(scenes_.size()), {}, {}});
        for (std::size_t scene = 0; scene < scenes_.size(); ++scene)
            if (auto done = run(result, scene); !done) return tl::unexpected(done.error());
        return result;
    }

  private:
    [[nodiscard]] std::string identity(const EffectsResult& result, const Key& key, std::size_t scene) const {
        return identity_of_text(fmt::format("errors 2 {} {:x} {:x} {:x}", scenes_[scene].identity,
                                            variants_.at(key).hash, variants_.at(full_rate(key)).hash,
                                            variants_.at(result.keys.front().key).hash));
    }

    [[nodiscard]] Key full_rate(const Key& key) const { return at_full_rate(family_, plan_, key); }

    /// All keys on one scene, as far as they have not been measured.
    Result<void> run(EffectsResult& result, std::size_t scene) {
        std::vector<std::size_t> missing;
        for (std::size_t i = 0; i < result.keys.size(); ++i) {
            const auto known = journal_.find(identity(result, result.keys[i].key, scene));
            const auto measured = known ? measurement_of(*known) : std::nullopt;
            if (measured)
                result.keys[i].scenes[scene] = *measured;
            else
                missing.push_back(i);
        }
        if (missing.empty()) return {};
        const auto points = find_points(family_, variants_.at(result.keys.front().key), scenes_[scene]);
        if (!points) return tl::unexpected(points.error());
        std::vector<Result<void>> done(missing.size());
        verify::for_each_index(missing.size(), options_.jobs, [&](std::size_t i) {
            done[i] = measure_one(*points, result, missing[i], scene);
        });
        for (const Result<void>& one : done)
            if (!one) return one;
        return {};
    }

    Result<void> measure_one(const ScenePoints& points, EffectsResult& result, std::size_t index,
                             std::size_t scene) {
        const Key& key = result.keys[index].key;
        const auto measured = measure(points, variants_.at(key), variants_.at(full_rate(key)));
        if (!measured) return tl::unexpected(measured.error());
        result.keys[index].scenes[scene] = *measured;
        return journal_.add(identity(result, key, scene), to_json(*measured));
    }

    const Family& family_;
    const StudyPlan& plan_;
    const Variants& variants_;
    const std::vector<DrawnScene>& scenes_;
    Journal& journal_;
    const StudyOptions& options_;
};

/// The keys, and those that they are compared with.
std::vector<Key> with_full_rates(const Family& family, const StudyPlan& plan, const std::vector<Key>& keys) {
    std::vector<Key> all = keys;
    for (const Key& key : keys) all.push_back(at_full_rate(family, plan, key));
    return all;
}

Result<EffectsResult> measure_keys_on(const Family& family, const SearchPath& search, const StudyPlan& plan,
                                      const Key& effects, const std::vector<Key>& keys,
                                      const std::vector<DrawnScene>& scenes, const StudyOptions& options,
                                      Journal& journal) {
    const Result<Variants> variants =
        load_variants(family, search, with_full_rates(family, plan, keys), options.jobs);
    if (!variants) return tl::unexpected(variants.error());
    return EffectsStudy(family, plan, *variants, scenes, journal, options).run(effects, keys);
}

Result<EffectsResult> study_effects(const Family& family, const SearchPath& search, const StudyPlan& plan,
                                    const Key& effects, const std::vector<DrawnScene>& scenes,
                                    const StudyOptions& options, Journal& journal) {
    const auto candidates = find_candidates(family, search, effects, scenes, options.weights, options.jobs);
    if (!candidates) return tl::unexpected(candidates.error());
    Result<EffectsResult> result =
        measure_keys_on(family, search, plan, effects, candidates->keys, scenes, options, journal);
    if (result) result->considered = candidates->considered;
    return result;
}

}  // namespace

Result<Study> run_study(const FileSystem& shipped, const Family& family, const SearchPath& search,
                        const StudyOptions& options, Journal& journal) {
    Study study;
    study.plan = options.plan;
    const Result<std::vector<DrawnScene>> scenes = draw_scenes(shipped, family, study.plan);
    if (!scenes) return tl::unexpected(scenes.error());
    for (const DrawnScene& scene : *scenes) study.scenes.push_back(scene.name);
    const std::vector<std::string>& wanted = !options.effects.empty() ? options.effects
                                             : options.quick          ? study.plan.quick
                                                                      : study.plan.effects;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        options.progress(wanted[i], i, wanted.size());
        const Result<Key> key = parse_key(family, wanted[i]);
        if (!key) return tl::unexpected(key.error());
        Result<EffectsResult> result =
            study_effects(family, search, study.plan, effects_of(family, *key), *scenes, options, journal);
        if (!result) return tl::unexpected(result.error());
        study.effects.push_back(std::move(*result));
    }
    options.progress("curves", wanted.size(), wanted.size());
    auto curves = measure_curves(shipped, family, search, study.plan, options.quick, options.jobs, journal);
    if (!curves) return tl::unexpected(curves.error());
    study.curves = std::move(*curves);
    auto changes = measure_changes(shipped, family, search, study.plan);
    if (!changes) return tl::unexpected(changes.error());
    study.changes = std::move(*changes);
    return study;
}

Result<EffectsResult> measure_keys(const FileSystem& shipped, const Family& family, const SearchPath& search,
                                   const Key& effects, const std::vector<Key>& keys,
                                   const StudyOptions& options, Journal& journal) {
    const Result<std::vector<DrawnScene>> scenes = draw_scenes(shipped, family, options.plan);
    if (!scenes) return tl::unexpected(scenes.error());
    return measure_keys_on(family, search, options.plan, effects, keys, *scenes, options, journal);
}

}  // namespace gobo::study
