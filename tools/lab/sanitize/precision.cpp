#include "lab/sanitize/precision.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "core/parallel.hpp"
#include "family/key.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/hard_points.hpp"

namespace gobo::sanitize {
namespace {

/// What makes a number jump.
constexpr std::uint32_t kSteps[] = {
    spv::OpConvertFToS,
    spv::OpConvertFToU,
    evaluate::kExtended + GLSLstd450Floor,
    evaluate::kExtended + GLSLstd450Ceil,
    evaluate::kExtended + GLSLstd450Round,
    evaluate::kExtended + GLSLstd450RoundEven,
    evaluate::kExtended + GLSLstd450Trunc,
    evaluate::kExtended + GLSLstd450FSign,
    evaluate::kExtended + GLSLstd450Step,
};

/// A number for all that an invocation decided: every comparison, and every step from floats to whole
/// numbers. Where it is the same in fp32 and fp64, what the outputs differ by is rounding; otherwise one of
/// them may stand on the other side of a jump.
template <class T>
class DecisionObserver final : public evaluate::Observer<T> {
  public:
    DecisionObserver(const evaluate::Program& program, std::size_t invocations) : decided_(invocations) {
        for (std::size_t at = 0; at < program.operations.size(); ++at) {
            const evaluate::Row& row = evaluate::instruction_table()[program.operations[at].row];
            const bool makes_truth = program.infos[at].result.scalar == evaluate::Scalar::boolean;
            const bool is_step =
                std::find(std::begin(kSteps), std::end(kSteps), row.code) != std::end(kSteps);
            decides_.push_back(is_step || (makes_truth && row.kind == evaluate::Kind::compare));
        }
    }
    void after(const evaluate::Step<T>& step) override {
        if (!decides_[step.operation]) return;
        const evaluate::Slice& result = step.info().result;
        for (std::size_t lane = 0; lane < evaluate::kLanes; ++lane) {
            if ((step.lanes >> lane & 1U) == 0) continue;
            std::uint64_t& decided = decided_[step.first_invocation + lane];
            for (std::uint32_t c = 0; c < result.count; ++c) {
                const auto value = static_cast<float>(step.value(result, c, lane));
                decided = (decided ^ std::bit_cast<std::uint32_t>(value) ^ step.operation) * 0x100000001b3U;
            }
        }
    }
    [[nodiscard]] std::uint64_t of(std::size_t invocation) const { return decided_[invocation]; }

  private:
    std::vector<bool> decides_;  ///< of each operation
    std::vector<std::uint64_t> decided_;
};

constexpr std::size_t kPoints = 1024;  ///< made and run at a time

/// Whether the operation has something to round: not where it moves, chooses or negates numbers, or cuts off
/// their digits.
bool rounds(const evaluate::Operation& operation) {
    using evaluate::Kind;
    const evaluate::Row& row = evaluate::instruction_table()[operation.row];
    if (row.code == spv::OpFNegate || row.kind == Kind::round || row.kind == Kind::min_max) return false;
    return row.kind <= Kind::matrix || row.kind == Kind::convert;
}

/// What an output's values at one invocation differ by.
struct Difference {
    std::uint32_t component = 0;
    double error = 0;
};

Difference difference(const std::vector<double>& fp32, const std::vector<double>& fp64,
                      std::size_t components, std::size_t count, std::size_t index) {
    double scale = 1;
    for (std::size_t c = 0; c < components; ++c) scale = std::max(scale, std::abs(fp64[c * count + index]));
    Difference result;
    if (!std::isfinite(scale)) return result;  // beyond doubles: nothing to compare with
    for (std::size_t c = 0; c < components; ++c) {
        double error = std::abs(fp32[c * count + index] - fp64[c * count + index]) / scale;
        if (std::isnan(fp64[c * count + index])) continue;
        if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
        if (error > result.error) result = {static_cast<std::uint32_t>(c), error};
    }
    return result;
}

/// Measures one stage.
class Measurement {
  public:
    Measurement(const evaluate::Program& program, const InputSpace& space, std::uint64_t seed)
        : program_(program), space_(space), random_(seed), seed_(seed) {
        worst_.resize(program.outputs.size());
    }

    Result<PrecisionReport> run(std::size_t points) {
        for (std::size_t done = 0; done < points; done += kPoints) {
            const std::size_t count = std::min(kPoints, points - done);
            const bool is_fresh = done < points / 2 || space_.numbers == 0;
            GOBO_TRY_DO(measure(is_fresh ? hard_points(space_, count, seed_++) : steps_from_worst(count)));
        }
        for (Worst& worst : worst_) {
            if (worst.loss.error == 0) continue;
            GOBO_TRY_DO(explain(worst));
            report_.outputs.push_back(std::move(worst.loss));
        }
        return std::move(report_);
    }

  private:
    /// The worst of an output.
    struct Worst {
        OutputLoss loss;
        std::vector<double> point;
    };

    Result<void> measure(const PointSet& points) {
        const evaluate::Invocations invocations = invocations_of(space_, points);
        DecisionObserver<float> decided32(program_, points.count);
        DecisionObserver<double> decided64(program_, points.count);
        GOBO_TRY(const auto fp32, evaluate::run<float>(program_, invocations, {}, &decided32));
        GOBO_TRY(const auto fp64, evaluate::run<double>(program_, invocations, {}, &decided64));
        for (std::size_t i = 0; i < points.count; ++i) {
            ++report_.points;
            if (fp64.discarded[i] || fp32.discarded[i]) continue;
            if (decided32.of(i) != decided64.of(i))
                ++report_.decided_otherwise;
            else
                judge(fp32, fp64, points, i);
        }
        return {};
    }

    void judge(const evaluate::Outputs& fp32, const evaluate::Outputs& fp64, const PointSet& points,
               std::size_t index) {
        for (std::size_t output = 0; output < worst_.size(); ++output) {
            const evaluate::Port& port = program_.outputs[output];
            const std::vector<double>& values32 = fp32.values.at(port.name);
            const std::vector<double>& values64 = fp64.values.at(port.name);
            const Difference found = difference(values32, values64, port.components, fp64.count, index);
            Worst& worst = worst_[output];
            if (found.error <= worst.loss.error) continue;
            const std::size_t at = found.component * fp64.count + index;
            worst.loss = {port.name, found.component, values32[at], values64[at], found.error, {}, {}, 0};
            worst.point.assign(points[index].begin(), points[index].end());
        }
    }

    /// Points beside the worst of each output in turn.
    PointSet steps_from_worst(std::size_t count) {
        PointSet points = hard_points(space_, count, seed_++);
        for (std::size_t i = 0; i < count; ++i) {
            const Worst& worst = worst_[i % worst_.size()];
            if (worst.point.empty()) continue;
            std::copy(worst.point.begin(), worst.point.end(), points[i].begin());
            change_any(space_, points[i], 1 + random_.index(3), random_);
        }
        return points;
    }

    /// Evaluates the worst point in fp64 once for each operation, with the results of only this one rounded
    /// to floats: what that changes is the operation's contribution.
    Result<void> explain(Worst& worst) {
        OutputLoss& loss = worst.loss;
        const std::size_t operations = program_.operations.size();
        PointSet points(space_.numbers, operations);
        for (std::size_t at = 0; at < operations; ++at)
            std::copy(worst.point.begin(), worst.point.end(), points[at].begin());
        const evaluate::Invocations invocations = invocations_of(space_, points);
        loss.point = point_of(program_, invocations, 0);
        std::vector<std::int64_t> rounded_in(operations);
        for (std::size_t at = 0; at < operations; ++at)
            rounded_in[at] = rounds(program_.operations[at]) ? static_cast<std::int64_t>(at) : -1;
        evaluate::Options options;
        options.rounded_in = &rounded_in;
        GOBO_TRY(const auto outputs, evaluate::run<double>(program_, invocations, options));
        const double* values = outputs.values.at(loss.output).data() + loss.component * operations;
        std::map<std::tuple<std::string, int, std::string>, Contribution> contributions;
        for (std::uint32_t at = 0; at < operations; ++at) {
            const double change = std::abs(values[at] - loss.fp64);
            if (!(change > 0)) continue;
            const Place& place = program_.place_of(at);
            const std::string name(evaluate::instruction_table()[program_.operations[at].row].name);
            Contribution& sum = contributions[{place.file, place.line, name}];
            sum.place = place;
            sum.operation = name;
            sum.change += change;
            loss.all_contributions += change;
        }
        for (auto& [where, contribution] : contributions) loss.contributions.push_back(contribution);
        std::stable_sort(loss.contributions.begin(), loss.contributions.end(),
                         [](const Contribution& a, const Contribution& b) { return a.change > b.change; });
        return {};
    }

    const evaluate::Program& program_;
    const InputSpace& space_;
    Random random_;
    std::uint64_t seed_;
    std::vector<Worst> worst_;  ///< of each output
    PrecisionReport report_;
};

using Json = nlohmann::ordered_json;

using Line = std::pair<const StagePrecision*, const OutputLoss*>;

/// The largest error first; the rest of the order only keeps it the same.
std::vector<Line> sorted_lines(const std::vector<StagePrecision>& stages) {
    std::vector<Line> lines;
    for (const StagePrecision& stage : stages)
        for (const OutputLoss& loss : stage.report.outputs) lines.push_back({&stage, &loss});
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Line& a, const Line& b) { return a.second->error > b.second->error; });
    return lines;
}

double share_of(const Contribution& contribution, const OutputLoss& loss) {
    return contribution.change / loss.all_contributions;
}

/// "fog/linear.glsl:15 FSub, 87 %"; a loss that no single rounding makes has no place.
std::string place_text(const OutputLoss& loss) {
    if (loss.contributions.empty()) return "-";
    const Contribution& most = loss.contributions.front();
    return fmt::format("{}:{} {}, {:.0f} %", most.place.file, most.place.line, most.operation,
                       100 * share_of(most, loss));
}

std::string keys_text(const StagePrecision& stage) {
    if (stage.keys.empty()) return "";
    const std::string first = stage.keys.front().empty() ? "default" : stage.keys.front();
    return stage.keys.size() == 1 ? first : fmt::format("{} and {} more", first, stage.keys.size() - 1);
}

Json json_of(const OutputLoss& loss) {
    Json contributions = Json::array();
    for (const Contribution& one : loss.contributions)
        contributions.push_back({{"file", one.place.file},
                                 {"line", one.place.line},
                                 {"operation", one.operation},
                                 {"change", one.change},
                                 {"share", share_of(one, loss)}});
    return contributions;
}

}  // namespace

Result<PrecisionReport> measure_precision(const evaluate::Program& program, const InputSpace& space,
                                          std::size_t points, std::uint64_t seed) {
    return Measurement(program, space, seed).run(points);
}

Result<std::vector<StagePrecision>> measure_precision(const Family& family, const Composition& composition,
                                                      const Validated& validated,
                                                      const SanitizeOptions& options) {
    std::vector<StagePrecision> stages(composition.stages.size());
    std::vector<Result<PrecisionReport>> reports(stages.size());
    parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
        stages[i].stage = composition.stages[i].kind;
        for (const std::size_t permutation : permutations_of(composition, i))
            stages[i].keys.push_back(key_text(family, composition.permutations[permutation].key));
        reports[i] = [&]() -> Result<PrecisionReport> {
            GOBO_TRY(const evaluate::Program program, evaluate::decode(validated.stages[i].spirv));
            return measure_precision(program, input_space_of(program, family.domains), options.points,
                                     options.seed);
        }();
    });
    for (std::size_t i = 0; i < stages.size(); ++i) {
        GOBO_TRY(stages[i].report, std::move(reports[i]));
    }
    return stages;
}

std::string precision_text(const std::vector<StagePrecision>& stages) {
    std::string text = fmt::format("{:<10} {:<14} {:<14} {:<18} {:<52} {}\n", "error", "fp32", "fp64",
                                   "output", "most of it from", "keys");
    for (const auto& [stage, loss] : sorted_lines(stages))
        text += fmt::format("{:<10.3g} {:<14.8g} {:<14.8g} {:<18} {:<52} {}\n", loss->error, loss->fp32,
                            loss->fp64, fmt::format("{}[{}]", loss->output, loss->component),
                            place_text(*loss), keys_text(*stage));
    std::uint64_t points = 0;
    std::uint64_t otherwise = 0;
    for (const StagePrecision& stage : stages) {
        points += stage.report.points;
        otherwise += stage.report.decided_otherwise;
    }
    return text + fmt::format("{} points, {} of them left out: fp32 took another side of a comparison\n",
                              points, otherwise);
}

std::string precision_json(const std::vector<StagePrecision>& stages) {
    Json outputs = Json::array();
    for (const auto& [stage, loss] : sorted_lines(stages))
        outputs.push_back({{"keys", stage->keys},
                           {"stage", name_of(stage->stage)},
                           {"output", loss->output},
                           {"component", loss->component},
                           {"error", loss->error},
                           {"fp32", loss->fp32},
                           {"fp64", loss->fp64},
                           {"contributions", json_of(*loss)},
                           {"inputs", loss->point.inputs},
                           {"uniforms", loss->point.uniforms},
                           {"samplers", loss->point.samplers}});
    return Json{{"outputs", outputs}}.dump(2) + "\n";
}

}  // namespace gobo::sanitize
