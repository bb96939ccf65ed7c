#include "lab/sanitize/precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/decision_observer.hpp"
#include "lab/sanitize/hard_inputs.hpp"
#include "lab/sanitize/point_changer.hpp"

namespace gobo::sanitize {
namespace {

constexpr std::size_t kPoints = 1024;  ///< made and run at a time

/// The points as one set of a single point, `count` times.
PointSet repeated(std::span<const double> point, std::size_t count) {
    PointSet points;
    points.numbers = point.size();
    points.resize(count);
    for (std::size_t i = 0; i < count; ++i) std::copy(point.begin(), point.end(), points[i].begin());
    return points;
}

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
        : program_(program), space_(space), changer_(space), random_(seed), seed_(seed) {
        worst_.resize(program.outputs.size());
    }

    Result<PrecisionReport> run(std::size_t points) {
        for (std::size_t done = 0; done < points; done += kPoints) {
            const std::size_t count = std::min(kPoints, points - done);
            const bool is_fresh = done < points / 2 || space_.numbers == 0;
            const Result<bool> ran =
                measure(is_fresh ? hard_points(space_, count, seed_++) : steps_from_worst(count));
            if (!ran) return tl::unexpected(ran.error());
        }
        for (std::size_t output = 0; output < worst_.size(); ++output) {
            if (worst_[output].error == 0) continue;
            Result<OutputLoss> loss = explain(output);
            if (!loss) return tl::unexpected(loss.error());
            report_.outputs.push_back(std::move(*loss));
        }
        return std::move(report_);
    }

  private:
    struct Worst {
        double error = 0;
        std::uint32_t component = 0;
        double fp32 = 0;
        double fp64 = 0;
        std::vector<double> point;
    };

    Result<bool> measure(const PointSet& points) {
        const evaluate::Invocations invocations = invocations_of(space_, points);
        DecisionObserver<float> decided32(program_, points.count());
        DecisionObserver<double> decided64(program_, points.count());
        const auto fp32 = evaluate::run<float>(program_, invocations, {}, &decided32);
        if (!fp32) return tl::unexpected(fp32.error());
        const auto fp64 = evaluate::run<double>(program_, invocations, {}, &decided64);
        if (!fp64) return tl::unexpected(fp64.error());
        for (std::size_t i = 0; i < points.count(); ++i) {
            ++report_.points;
            if (fp64->discarded[i] || fp32->discarded[i]) continue;
            if (decided32.of(i) != decided64.of(i))
                ++report_.decided_otherwise;
            else
                judge(*fp32, *fp64, points, i);
        }
        return true;
    }

    void judge(const evaluate::Outputs& fp32, const evaluate::Outputs& fp64, const PointSet& points,
               std::size_t index) {
        for (std::size_t output = 0; output < worst_.size(); ++output) {
            const evaluate::Port& port = program_.outputs[output];
            const std::vector<double>& values32 = fp32.values.at(port.name);
            const std::vector<double>& values64 = fp64.values.at(port.name);
            const Difference found = difference(values32, values64, port.components, fp64.count, index);
            if (found.error <= worst_[output].error) continue;
            const std::size_t at = found.component * fp64.count + index;
            const std::span<const double> point = points[index];
            worst_[output] = {
                found.error, found.component, values32[at], values64[at], {point.begin(), point.end()}};
        }
    }

    /// Points beside the worst of each output in turn.
    PointSet steps_from_worst(std::size_t count) {
        PointSet points = hard_points(space_, count, seed_++);
        for (std::size_t i = 0; i < count; ++i) {
            const Worst& worst = worst_[i % worst_.size()];
            if (worst.point.empty()) continue;
            std::copy(worst.point.begin(), worst.point.end(), points[i].begin());
            for (std::size_t changes = 1 + random_.index(3); changes > 0; --changes)
                (void)changer_.change(points[i], random_.index(space_.numbers), random_);
        }
        return points;
    }

    /// Evaluates the worst point in fp64 once for each operation, with the results of only this one rounded
    /// to floats: what that changes is the operation's contribution.
    Result<OutputLoss> explain(std::size_t output) {
        const Worst& worst = worst_[output];
        const evaluate::Port& port = program_.outputs[output];
        OutputLoss loss{port.name, worst.component, worst.fp32, worst.fp64, worst.error, {}, {}, 0};
        const std::size_t operations = program_.operations.size();
        const evaluate::Invocations invocations = invocations_of(space_, repeated(worst.point, operations));
        loss.point = point_of(program_, invocations, 0);
        std::vector<std::int64_t> rounded_in(operations);
        for (std::size_t at = 0; at < operations; ++at)
            rounded_in[at] = rounds(program_.operations[at]) ? static_cast<std::int64_t>(at) : -1;
        evaluate::Options options;
        options.rounded_in = &rounded_in;
        const auto outputs = evaluate::run<double>(program_, invocations, options);
        if (!outputs) return tl::unexpected(outputs.error());
        const double* values = outputs->values.at(port.name).data() + worst.component * operations;
        std::map<std::tuple<std::string, int, std::string>, Contribution> contributions;
        for (std::uint32_t at = 0; at < operations; ++at) {
            const double change = std::abs(values[at] - worst.fp64);
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
        return loss;
    }

    const evaluate::Program& program_;
    const InputSpace& space_;
    PointChanger changer_;
    Random random_;
    std::uint64_t seed_;
    std::vector<Worst> worst_;  ///< of each output
    PrecisionReport report_;
};

}  // namespace

Result<PrecisionReport> measure_precision(const evaluate::Program& program, const InputSpace& space,
                                          std::size_t points, std::uint64_t seed) {
    return Measurement(program, space, seed).run(points);
}

}  // namespace gobo::sanitize
