#include "lab/study/worst_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/parallel.hpp"
#include "family/key.hpp"
#include "lab/oracle/model.hpp"
#include "lab/raster/random_numbers.hpp"
#include "lab/study/qualities.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::study {
namespace {

using verify::Sample;

constexpr std::size_t kPortion = 512;
constexpr std::size_t kKept = 24;  ///< worst inputs that are varied

class Random : public RandomNumbers<Xoshiro256> {
  public:
    using RandomNumbers::RandomNumbers;
    bool one_in(std::size_t n) { return index(n) == 0; }
    double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
};

/// Puts the sample where models have their edges: any shininess, narrow cones, the point beside their edge.
void bring_to_edges(Sample& sample, Random& random) {
    sample.scene.material.shininess =
        random.one_in(2) ? random.log_between(0.1, 10) : random.log_between(0.1, 1e6);
    for (oracle::SpotLight& light : sample.scene.spot) {
        const double outer = random.log_between(1e-3, std::numbers::pi);
        const double inner = outer * (random.one_in(2) ? random.unit() : 1 - random.log_between(1e-3, 1));
        light.outer_one_minus_cosine = 2 * std::pow(std::sin(outer / 2), 2);
        light.inner_one_minus_cosine = 2 * std::pow(std::sin(inner / 2), 2);
        const glm::dvec3 ray = sample.surface.position - light.position;
        if (glm::length(ray) == 0) continue;
        // Turned away from the point by an angle within the soft edge.
        const double angle = inner + (outer - inner) * random.unit();
        const glm::dvec3 to_point = glm::normalize(ray);
        glm::dvec3 aside{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        aside = glm::cross(to_point, aside);
        if (glm::length(aside) == 0) continue;
        light.axis = std::cos(angle) * to_point + std::sin(angle) * glm::normalize(aside);
    }
}

/// A number, vector or matrix that both stages may read.
struct SearchedField {
    verify::Field field;
    std::string name;
    std::optional<Domain> domain;
    bool is_direction = false;
};

bool is_direction(const std::string& name) {
    return name.ends_with(".direction") || name.ends_with(".axis") || name == "eyeNormal";
}

std::vector<SearchedField> fields_of(const evaluate::Program& program, const std::vector<Domain>& narrower,
                                     const std::vector<Domain>& domains) {
    std::vector<SearchedField> fields;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            const auto field = verify::field_of(port.name);
            if (!field || port.scalar != evaluate::Scalar::float32) continue;
            const Domain* domain = verify::domain_of(narrower, port.name);
            if (domain == nullptr) domain = verify::domain_of(domains, port.name);
            fields.push_back({*field, port.name, domain == nullptr ? std::nullopt : std::optional(*domain),
                              is_direction(port.name)});
        }
    return fields;
}

void bring_into_domain(const SearchedField& field, Sample& sample) {
    std::vector<double> numbers = field.field.get(sample);
    double square = 0;
    for (const double number : numbers) square += number * number;
    if (field.is_direction && square > 0) {
        for (double& number : numbers) number /= std::sqrt(square);
    } else if (field.domain && !field.domain->of_length) {
        for (double& number : numbers) {
            const auto& also = field.domain->also;
            if (std::ranges::find(also, number) == also.end())
                number = std::clamp(number, field.domain->low, field.domain->high);
        }
    }
    field.field.set(sample, numbers);
}

/// One quality against the most accurate one.
class Search {
  public:
    Search(const Family& family, const Variant& choice, const Variant& accurate, const oracle::Model& model,
           const oracle::Model& own_model, const WorstCaseOptions& options)
        : choice_(choice),
          accurate_(accurate),
          model_(model),
          own_model_(own_model),
          options_(options),
          random_(options.seed),
          fields_(fields_of(choice.program.fragment, options.domains, family.domains)) {}

    Result<WorstCase> run() {
        for (std::size_t done = 0; done < options_.points; done += kPortion) {
            const std::size_t count = std::min(kPortion, options_.points - done);
            const bool is_fresh = kept_.empty() || done / kPortion % 2 == 0;
            std::vector<Sample> samples = is_fresh ? drawn(count) : varied(count);
            for (Sample& sample : samples)
                for (const SearchedField& field : fields_) bring_into_domain(field, sample);
            GOBO_TRY_DO(judge(verify::rounded_to_float(std::move(samples))));
        }
        return std::move(worst_);
    }

  private:
    /// An input and by how much the choice errs more there.
    struct Kept {
        double excess = 0;
        Sample sample;
    };

    std::vector<Sample> drawn(std::size_t count) {
        std::vector<Sample> samples = verify::make_samples(own_model_, StageKind::fragment,
                                                           static_cast<int>(count), ++draws_ + options_.seed);
        for (Sample& sample : samples)
            if (!random_.one_in(4)) bring_to_edges(sample, random_);
        return samples;
    }

    std::vector<Sample> varied(std::size_t count) {
        std::vector<Sample> samples;
        for (std::size_t i = 0; i < count; ++i) {
            Sample& sample = samples.emplace_back(random_.pick(kept_).sample);
            for (std::size_t changes = 1 + random_.index(3); changes > 0; --changes) change(sample);
        }
        return samples;
    }

    void change(Sample& sample) {
        const SearchedField& field = random_.pick(fields_);
        std::vector<double> numbers = field.field.get(sample);
        if (numbers.empty()) return;
        double& number = numbers[random_.index(numbers.size())];
        const double size = std::exp2(random_.between(-20, 1));
        if (field.is_direction)
            number += size * random_.between(-1, 1);
        else
            number *=
                random_.one_in(8) ? std::exp2(random_.between(-3, 3)) : 1 + size * random_.between(-1, 1);
        field.field.set(sample, numbers);
    }

    Result<void> judge(const std::vector<Sample>& samples) {
        GOBO_TRY(const auto invocations, verify::bind_inputs(choice_.program.fragment, samples));
        GOBO_TRY(const auto accurate_invocations, verify::bind_inputs(accurate_.program.fragment, samples));
        GOBO_TRY(const auto outputs, evaluate::run<float>(choice_.program.fragment, invocations));
        GOBO_TRY(const auto accurate, evaluate::run<float>(accurate_.program.fragment, accurate_invocations));
        for (std::size_t i = 0; i < samples.size(); ++i) {
            ++worst_.points;
            oracle::Decisions decisions;
            const auto all = verify::expect(model_, StageKind::fragment, samples[i], decisions);
            const auto expected = std::ranges::find(all, choice_.program.color, &verify::Expected::output);
            if (decisions.open() > 0 || expected == all.end() || outputs.discarded[i]) continue;
            const double error = error_of(outputs, *expected, i);
            const double accurate_error = error_of(accurate, *expected, i);
            if (!std::isfinite(error) || !std::isfinite(accurate_error)) continue;
            keep(error - accurate_error, samples[i]);
            if (error - accurate_error <= worst_.error - worst_.accurate_error) continue;
            worst_.error = error;
            worst_.accurate_error = accurate_error;
            worst_.input = evaluate::point_of(choice_.program.fragment, invocations, i);
        }
        return {};
    }

    [[nodiscard]] double error_of(const evaluate::Outputs& outputs, const verify::Expected& expected,
                                  std::size_t invocation) const {
        const std::vector<double>& values = outputs.values.at(choice_.program.color);
        double error = 0;
        for (std::size_t c = 0; c < 3; ++c)
            error = std::max(error, std::abs(values[c * outputs.count + invocation] - expected.value[c]) /
                                        std::max(expected.largest[c], 1.0));
        return error;
    }

    void keep(double excess, const Sample& sample) {
        if (kept_.size() < kKept) {
            kept_.push_back({excess, sample});
            return;
        }
        const auto least = std::ranges::min_element(kept_, {}, &Kept::excess);
        if (excess > least->excess) *least = {excess, sample};
    }

    const Variant& choice_;
    const Variant& accurate_;
    const oracle::Model& model_;
    const oracle::Model& own_model_;
    const WorstCaseOptions& options_;
    Random random_;
    std::uint64_t draws_ = 0;
    std::vector<SearchedField> fields_;
    std::vector<Kept> kept_;
    WorstCase worst_;
};

}  // namespace

Result<std::vector<WorstCase>> find_worst_cases(const Subject& subject, const std::vector<Key>& effects,
                                                const std::vector<int>& rate,
                                                const WorstCaseOptions& options) {
    const Family& family = subject.family;
    std::vector<Key> keys;
    std::vector<std::pair<Key, Key>> wanted;  // effects and choice
    for (const Key& of : effects) {
        keys.push_back(most_accurate(family, of));
        for (const Choice& choice : single_choices(family, of)) {
            if (std::ranges::find(rate, choice.feature) != rate.end()) continue;
            keys.push_back(choice.key);
            wanted.emplace_back(of, choice.key);
        }
    }
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    GOBO_TRY(const Variants variants, load_variants(subject, std::move(keys)));
    std::vector<std::optional<Result<WorstCase>>> found(wanted.size());
    parallel_for(subject.jobs, wanted.size(), [&](std::size_t i) {
        const auto& [of, key] = wanted[i];
        const Key accurate = most_accurate(family, of);
        const auto model = oracle::model_of(family, accurate);
        const auto own = oracle::model_of(family, key);
        if (!model || !own) return;
        found[i] = Search(family, variants.at(key), variants.at(accurate), *model, *own, options).run();
    });
    std::vector<WorstCase> cases;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (!found[i]) continue;
        GOBO_TRY(WorstCase worst, std::move(*found[i]));
        worst.effects = wanted[i].first;
        worst.key = wanted[i].second;
        cases.push_back(std::move(worst));
    }
    return cases;
}

std::vector<Promise> broken_promises(const Family& family, const std::vector<Promise>& promises,
                                     const std::vector<WorstCase>& cases) {
    std::vector<Promise> broken;
    for (const Promise& promise : promises)
        if (std::ranges::any_of(cases, [&](const WorstCase& worst) {
                return quality_text(family, worst.key) == promise.quality && worst.error > promise.error;
            }))
            broken.push_back(promise);
    return broken;
}

std::string worst_case_csv(const Family& family, const std::vector<WorstCase>& cases) {
    std::string text = "effects,quality,worst,most_accurate,points\n";
    for (const WorstCase& worst : cases)
        text += fmt::format("{},{},{:.3g},{:.3g},{}\n", key_text(family, worst.effects),
                            quality_text(family, worst.key), worst.error, worst.accurate_error, worst.points);
    return text;
}

}  // namespace gobo::study
