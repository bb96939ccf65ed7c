#include "lab/study/worst_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/oracle/model.hpp"
#include "lab/study/parallel_results.hpp"
#include "lab/study/qualities.hpp"
#include "lab/study/worst_inputs.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::study {
namespace {

using verify::Sample;

constexpr std::size_t kPortion = 512;
constexpr std::size_t kKept = 24;  ///< worst inputs that are varied, with one lamp and with all

/// One key against the oracle's most accurate model.
class Search {
  public:
    Search(const Family& family, const Variant& variant, const oracle::Model& model,
           const oracle::Model& own_model, const WorstCaseOptions& options, bool is_half)
        : variant_(variant),
          model_(model),
          own_model_(own_model),
          options_(options),
          is_half_(is_half),
          random_(options.seed),
          fields_(searched_fields(variant.program.fragment, family.domains)),
          orders_(searched_orders(fields_, family.domains)) {}

    Result<WorstCase> run() {
        for (std::size_t done = 0; done < options_.points; done += kPortion) {
            const std::size_t portion = done / kPortion;
            // Each second pair of portions has one lamp only: what is worst there must not be crowded out.
            const bool is_alone = portion / 2 % 2 == 1;
            GOBO_TRY_DO(search(std::min(kPortion, options_.points - done), portion, is_alone,
                               is_alone ? kept_alone_ : kept_));
        }
        // An eighth more beside the viewer and the lamps.
        is_near_ = true;
        for (std::size_t done = 0; done < options_.points / 8; done += kPortion)
            GOBO_TRY_DO(search(std::min(kPortion, options_.points / 8 - done), done / kPortion,
                               done / kPortion / 2 % 2 == 0, kept_near_));
        return std::move(worst_);
    }

  private:
    /// An input and by how much more the key errs there than roundings explain.
    struct Kept {
        double excess = 0;
        Sample sample;
    };

    /// Judges a portion of points: drawn, or each second time varied from those kept.
    Result<void> search(std::size_t count, std::size_t portion, bool is_alone, std::vector<Kept>& kept) {
        if (worst_.error > options_.enough) return {};
        const bool is_fresh = kept.empty() || portion % 2 == 0;
        std::vector<Sample> samples = is_fresh ? drawn(count, is_alone) : varied(count, kept);
        for (Sample& sample : samples) {
            for (const SearchedField& field : fields_) bring_into_domain(field, sample);
            are_in_order(sample);
            if (model_.environment_brdf == oracle::EnvironmentBrdf::table) look_up_table(model_, sample);
        }
        std::erase_if(samples, [&](Sample& sample) { return !are_in_order(sample); });
        if (samples.empty()) return {};
        return judge(verify::rounded_to_float(std::move(samples)), kept);
    }

    /// Puts the sample into each order; whether all could be kept, one beside the other.
    bool are_in_order(Sample& sample) {
        std::size_t kept = 0;
        for (const SearchedOrder& order : orders_) kept += bring_into_order(order, fields_, sample) ? 1 : 0;
        return kept == orders_.size();
    }

    std::vector<Sample> drawn(std::size_t count, bool is_alone) {
        std::vector<Sample> samples = verify::make_samples(own_model_, StageKind::fragment,
                                                           static_cast<int>(count), ++draws_ + options_.seed);
        for (Sample& sample : samples) {
            if (!random_.one_in(4)) bring_to_edges(sample, random_);
            if (is_alone) leave_one_light(sample.scene, random_);
            while (!fields_.empty() && random_.one_in(3)) bring_to_end(lit_field(sample), sample, random_);
            if (is_near_) bring_near(sample, random_);
        }
        return samples;
    }

    std::vector<Sample> varied(std::size_t count, const std::vector<Kept>& kept) {
        std::vector<Sample> samples;
        for (std::size_t i = 0; i < count; ++i) {
            Sample& sample = samples.emplace_back(random_.pick(kept).sample);
            for (std::size_t changes = 1 + random_.index(3); changes > 0; --changes) change(sample);
        }
        return samples;
    }

    /// A field that is not of a light that is out; after some tries any: of many lights only one may shine.
    const SearchedField& lit_field(const Sample& sample) {
        const SearchedField* field = &random_.pick(fields_);
        for (std::size_t tries = 0; tries < 2 * fields_.size() && is_of_dark_light(*field, sample.scene);
             ++tries)
            field = &random_.pick(fields_);
        return *field;
    }

    void change(Sample& sample) {
        if (fields_.empty()) return;
        const SearchedField& field = lit_field(sample);
        if (random_.one_in(16)) return bring_to_end(field, sample, random_);
        std::vector<double> numbers = field.field.get(sample);
        if (numbers.empty()) return;
        double& number = numbers[random_.index(numbers.size())];
        const double size = std::exp2(random_.between(-20, 1));
        if (field.is_of_length())
            number += size * random_.between(-1, 1);
        else
            number *=
                random_.one_in(8) ? std::exp2(random_.between(-3, 3)) : 1 + size * random_.between(-1, 1);
        field.field.set(sample, numbers);
    }

    Result<void> judge(const std::vector<Sample>& samples, std::vector<Kept>& kept) {
        const evaluate::Program& program = variant_.program.fragment;
        GOBO_TRY(const auto invocations, verify::bind_inputs(program, samples));
        GOBO_TRY(const auto outputs, evaluate::run<float>(program, invocations, {.is_half = is_half_}));
        for (std::size_t i = 0; i < samples.size(); ++i) {
            ++worst_.points;
            oracle::Decisions decisions;
            const auto all = verify::expect(model_, StageKind::fragment, samples[i], decisions);
            const auto expected = std::ranges::find(all, variant_.program.color, &verify::Expected::output);
            if (decisions.open() > 0 || expected == all.end() || outputs.discarded[i]) continue;
            const auto [excess, rounding] = excess_of(outputs, *expected, i);
            keep(excess, samples[i], kept);
            if (excess <= worst_.error) continue;
            worst_.error = excess;
            worst_.rounding = rounding;
            worst_.input = evaluate::point_of(program, invocations, i);
        }
        return {};
    }

    /// Of the worst channel: its error beyond the bound of rounding, and that bound.
    [[nodiscard]] std::pair<double, double> excess_of(const evaluate::Outputs& outputs,
                                                      const verify::Expected& expected,
                                                      std::size_t invocation) const {
        const std::vector<double>& values = outputs.values.at(variant_.program.color);
        std::pair<double, double> worst{-std::numeric_limits<double>::infinity(), 0};
        for (std::size_t c = 0; c < 3; ++c) {
            const double unit = std::max(expected.whole[c], 1.0);
            const double error = std::abs(values[c * outputs.count + invocation] - expected.value[c]);
            if (!std::isfinite(expected.value[c]) || !std::isfinite(expected.float_error[c])) continue;
            const double excess = std::isfinite(error) ? (error - expected.float_error[c]) / unit
                                                       : std::numeric_limits<double>::infinity();
            if (excess > worst.first) worst = {excess, expected.float_error[c] / unit};
        }
        return worst;
    }

    static void keep(double excess, const Sample& sample, std::vector<Kept>& kept) {
        if (kept.size() < kKept) {
            kept.push_back({excess, sample});
            return;
        }
        const auto least = std::ranges::min_element(kept, {}, &Kept::excess);
        if (excess > least->excess) *least = {excess, sample};
    }

    const Variant& variant_;
    const oracle::Model& model_;
    const oracle::Model& own_model_;
    const WorstCaseOptions& options_;
    bool is_half_;  ///< what is mediump is a 16-bit float
    SearchRandom random_;
    std::uint64_t draws_ = 0;
    std::vector<SearchedField> fields_;
    std::vector<SearchedOrder> orders_;
    std::vector<Kept> kept_;
    std::vector<Kept> kept_alone_;  ///< with one lamp
    bool is_near_ = false;          ///< what is drawn lies beside the viewer and the lamps
    std::vector<Kept> kept_near_;
    WorstCase worst_;
};

/// The family with what has that name declared mediump.
Family declared_mediump(Family family, const std::string& name) {
    family.extends = true;  // its pieces are changed, though they are shipped
    const auto varying = std::ranges::find(family.varyings, name, &Varying::name);
    if (varying != family.varyings.end()) {
        varying->type = "mediump " + varying->type;
        return family;
    }
    for (const char* const type : {"float", "vec2", "vec3", "vec4", "mat2", "mat3", "mat4"})
        family.substitutions.emplace(fmt::format("{} {}", type, name),
                                     fmt::format("mediump {} {}", type, name));
    return family;
}

/// The keys with one name declared mediump.
Result<Variants> mediump_variants(const Subject& subject, std::vector<Key> keys, const std::string& mediump) {
    const Family family = declared_mediump(subject.family, mediump);
    GOBO_TRY(Variants variants, load_variants({subject.shipped, family, subject.search, subject.jobs},
                                              std::move(keys), Dialect::es300));
    const auto has_name = [](const Variant& variant) {
        return std::ranges::any_of(variant.program.fragment.infos, &evaluate::OperationInfo::is_relaxed);
    };
    if (std::ranges::none_of(variants.all, has_name))
        return fail(Fault::usage, fmt::format("no fragment stage has a float '{}'", mediump),
                    "name a varying, or a variable as its piece declares it: vec3 litNormal");
    return variants;
}

/// Where a range is stated of a component that an input of the stage does not have.
Result<void> refuse_unknown_components(const Family& family, const Variant& variant) {
    for (const auto* const ports : {&variant.program.fragment.inputs, &variant.program.fragment.uniforms})
        for (const evaluate::Port& port : *ports)
            for (const Domain& domain : family.domains) {
                const auto part = component_name(domain.name);
                if (part && part->of == without_subscripts(port.name) && part->component >= port.components)
                    return fail(domain.place, "",
                                fmt::format("'{}' has {} components", part->of, port.components),
                                fmt::format("end at .{}", "xyzw"[port.components - 1]));
            }
    return {};
}

/// Whether the fragments are handed nothing that the most accurate key computes for each of them.
bool is_per_fragment(const Variant& variant, const Variant& accurate) {
    const auto& known = accurate.program.fragment.inputs;
    return std::ranges::all_of(variant.program.fragment.inputs, [&](const evaluate::Port& port) {
        return std::ranges::find(known, port.name, &evaluate::Port::name) != known.end();
    });
}

}  // namespace

Result<std::vector<WorstCase>> find_worst_cases(const Subject& subject, const std::vector<Key>& keys,
                                                const WorstCaseOptions& options) {
    const Family& family = subject.family;
    std::vector<Key> needed;
    for (const Key& key : keys) {
        needed.push_back(key);
        needed.push_back(most_accurate(family, key));
    }
    std::ranges::sort(needed);
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    GOBO_TRY(const Variants variants, load_variants(subject, std::move(needed)));
    Variants in_half;
    if (options.mediump.empty()) {
        std::vector<Key> of_es300 = keys;
        std::erase_if(of_es300, [&](const Key& key) { return is_valid(family, key); });
        GOBO_TRY(in_half, load_variants(subject, std::move(of_es300), Dialect::es300));
    } else {
        GOBO_TRY(in_half, mediump_variants(subject, keys, options.mediump));
    }
    for (const Variant& variant : variants.all) GOBO_TRY_DO(refuse_unknown_components(family, variant));
    std::vector<Key> searched;
    std::vector<std::pair<oracle::Model, oracle::Model>> models;  // the most accurate one, the key's own
    for (const Key& key : keys) {
        const Key accurate = most_accurate(family, key);
        const auto model = oracle::model_of(family, accurate);
        const auto own = oracle::model_of(family, key);
        if (!model || !own || !is_per_fragment(variants.at(key), variants.at(accurate))) continue;
        searched.push_back(key);
        models.emplace_back(*model, *own);
    }
    return parallel_results(subject.jobs, searched.size(), [&](std::size_t i) -> Result<WorstCase> {
        const bool is_half = in_half.index.contains(searched[i]);
        const Variant& variant = (is_half ? in_half : variants).at(searched[i]);
        Search search(family, variant, models[i].first, models[i].second, options, is_half);
        GOBO_TRY(WorstCase worst, search.run());
        worst.effects = effects_of(family, searched[i]);
        worst.key = searched[i];
        return worst;
    });
}

std::vector<BrokenPromise> broken_promises(const Family& family, const std::vector<Promise>& promises,
                                           const std::vector<WorstCase>& cases) {
    std::vector<BrokenPromise> broken;
    for (const Promise& promise : promises) {
        double error = promise.error;
        for (const WorstCase& worst : cases)
            if (quality_text(family, worst.key) == promise.quality ||
                key_text(family, worst.key) == promise.quality)
                error = std::max(error, worst.error);
        if (error > promise.error) broken.push_back({promise, error});
    }
    return broken;
}

CsvTable with_worst(CsvTable study, const Family& family, const std::vector<WorstCase>& cases) {
    std::map<std::string, double> errors;
    for (const WorstCase& worst : cases) errors[key_text(family, worst.key)] = worst.error;
    constexpr const char* kColumn = "error_worst";
    if (!study.column(kColumn)) {
        study.columns.emplace_back(kColumn);
        for (auto& row : study.rows) row.emplace_back();
    }
    const std::size_t at = study.column(kColumn).value();
    const auto key_at = study.column("key");
    const auto scene_at = study.column("scene");
    for (auto& row : study.rows) {
        const auto found = key_at ? errors.find(row[*key_at]) : errors.end();
        const bool is_of_all = scene_at && row[*scene_at] == kAllScenes;
        row[at] = !is_of_all ? "" : found == errors.end() ? "none" : fmt::format("{:.3g}", found->second);
    }
    return study;
}

std::string worst_case_csv(const Family& family, const std::vector<WorstCase>& cases) {
    std::string text = "effects,quality,worst,rounding,points\n";
    for (const WorstCase& worst : cases)
        text += fmt::format("{},{},{:.3g},{:.3g},{}\n", key_text(family, worst.effects),
                            quality_text(family, worst.key), worst.error, worst.rounding, worst.points);
    return text;
}

}  // namespace gobo::study
