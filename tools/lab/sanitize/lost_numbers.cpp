#include "lab/sanitize/lost_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/input_space.hpp"
#include "lab/sanitize/step_text.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::Outputs;
using evaluate::Program;
using Counts = std::vector<std::uint32_t>;

/// Of an 8-bit colour: the least step that is seen.
constexpr double kLeastStep = 1.0 / 255;
/// Times that inputs are moved, each number up or down: what half of the moves change is seen but once in
/// 2^24.
constexpr int kMoves = 24;
/// Half the distance of neighbouring numbers beside 1.
constexpr double kRoundingOfHalf = 0x1p-11;
constexpr double kRoundingOfFloat = 0x1p-24;

/// Loops that are not left where small numbers are kept end, and the other invocations go on.
class Patient final : public evaluate::Observer<float> {
    [[nodiscard]] bool gives_up(const evaluate::Block& /*loop*/, std::uint64_t /*lanes*/,
                                std::size_t /*first_invocation*/) override {
        return true;
    }
};

/// What some operations do in some invocations, in words.
class StepRecorder final : public evaluate::Observer<float> {
  public:
    /// Operations by invocation.
    explicit StepRecorder(std::map<std::size_t, std::uint32_t> wanted) : wanted_(std::move(wanted)) {}

    void before(const evaluate::Step<float>& step) override {
        for_each_wanted(step, [&](std::size_t lane, std::string& text) { text = operands_text(step, lane); });
    }
    void after(const evaluate::Step<float>& step) override {
        for_each_wanted(step, [&](std::size_t lane, std::string& text) {
            if (step.row().code != evaluate::kScatter) text += " -> " + result_text(step, lane);
        });
    }
    [[nodiscard]] bool gives_up(const evaluate::Block& /*loop*/, std::uint64_t /*lanes*/,
                                std::size_t /*first_invocation*/) override {
        return true;
    }
    [[nodiscard]] const std::string& text_of(std::size_t invocation) { return texts_[invocation]; }

  private:
    template <class Do>
    void for_each_wanted(const evaluate::Step<float>& step, const Do& act) {
        for (auto at = wanted_.lower_bound(step.first_invocation);
             at != wanted_.end() && at->first < step.first_invocation + evaluate::kLanes; ++at) {
            const std::size_t lane = at->first - step.first_invocation;
            if (at->second == step.operation && (step.lanes >> lane & 1U) != 0) act(lane, texts_[at->first]);
        }
    }

    std::map<std::size_t, std::uint32_t> wanted_;
    std::map<std::size_t, std::string> texts_;
};

/// Where an output differs most from what it is with small numbers.
struct Difference {
    const evaluate::Port* output = nullptr;  ///< nullptr: the fragment is discarded in one of the two
    std::uint32_t component = 0;
    double size = 0;  ///< in such steps
};

class Comparison {
  public:
    Comparison(const Program& program, const evaluate::Invocations& invocations,
               const evaluate::Options& options, const Outputs& lossy)
        : program_(program),
          invocations_(invocations),
          options_(options),
          lossy_(lossy),
          items_(static_cast<std::uint32_t>(program.constants.size() + program.operations.size())),
          together_(evaluate::needs_quads(program) ? 4 : 1) {}

    Result<std::vector<LostNumber>> run(const std::function<bool(std::size_t)>& is_judged) {
        GOBO_TRY(kept_, run_with(invocations_, Counts{0}));
        for (std::size_t i = 0; i < invocations_.count; ++i) {
            const Difference found = is_judged(i) ? largest_difference(i) : Difference{};
            if (found.size > 1 && !is_of_same_quad(i)) differences_[i] = found;
        }
        GOBO_TRY_DO(leave_out_uncertain());
        if (differences_.empty()) return std::vector<LostNumber>{};
        return named();
    }

  private:
    [[nodiscard]] bool is_of_same_quad(std::size_t invocation) const {
        return !differences_.empty() && differences_.rbegin()->first / together_ == invocation / together_;
    }

    /// The outputs where only so many constants and operations of each invocation lose small numbers.
    [[nodiscard]] Result<Outputs> run_with(const evaluate::Invocations& invocations,
                                           const Counts& losing) const {
        evaluate::Options options = options_;
        options.loses_small = &losing;
        Patient patient;
        return evaluate::run<float>(program_, invocations, options, &patient);
    }

    [[nodiscard]] double value(const Outputs& outputs, const evaluate::Port& port, std::uint32_t component,
                               std::size_t invocation) const {
        return outputs.values.at(port.name)[component * invocations_.count + invocation];
    }

    /// In steps; of a fragment that one of the two discards, as large as can be.
    [[nodiscard]] Difference largest_difference(std::size_t i) const {
        if (lossy_.discarded[i] != kept_.discarded[i])
            return {nullptr, 0, std::numeric_limits<double>::infinity()};
        Difference largest;
        for (const evaluate::Port& port : program_.outputs) {
            if (lossy_.discarded[i]) continue;
            for (std::uint32_t c = 0; c < port.components; ++c) {
                const double size =
                    std::fabs(value(lossy_, port, c, i) - value(kept_, port, c, i)) / step(port, i);
                if (std::isfinite(size) && size > largest.size) largest = {&port, c, size};
            }
        }
        return largest;
    }

    /// Of the output's values: absolute up to 1, relative above. Of whole numbers every other one counts.
    [[nodiscard]] double step(const evaluate::Port& port, std::size_t invocation) const {
        if (!evaluate::is_float(port.scalar)) return 0.5;
        double largest = 1;
        for (std::uint32_t c = 0; c < port.components; ++c)
            largest = std::max(largest, std::fabs(value(kept_, port, c, invocation)));
        return kLeastStep * largest;
    }

    /// How far the output at hand is in other outputs from what it is with small numbers.
    [[nodiscard]] double distance(const Outputs& outputs, std::size_t i, const Difference& at) const {
        if (outputs.discarded[i] != kept_.discarded[i]) return std::numeric_limits<double>::infinity();
        if (at.output == nullptr) return 0;
        const double moved = value(outputs, *at.output, at.component, i);
        const double size =
            std::fabs(moved - value(kept_, *at.output, at.component, i)) / step(*at.output, i);
        return std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
    }

    /// Beside an edge, where roundings of the inputs decide alone, nothing is lost that was there.
    Result<void> leave_out_uncertain() {
        Random random(1);
        for (int move = 0; move < kMoves && !differences_.empty(); ++move) {
            GOBO_TRY(const Outputs moved, run_with(moved_inputs(random), Counts{0}));
            std::erase_if(differences_, [&](const auto& one) {
                return 2 * distance(moved, one.first, one.second) >= one.second.size;
            });
        }
        return {};
    }

    /// Every number up or down by a rounding of the largest component beside it.
    [[nodiscard]] evaluate::Invocations moved_inputs(Random& random) const {
        evaluate::Invocations moved = invocations_;
        const std::size_t count = invocations_.count;
        for (auto& [name, numbers] : moved.values) {
            const evaluate::Port* port = evaluate::find_port(program_.inputs, name);
            if (port == nullptr) port = evaluate::find_port(program_.uniforms, name);
            if (port == nullptr || !evaluate::is_float(port->scalar)) continue;
            const std::size_t each = numbers.size() / port->components;
            std::vector<double> largest(each, 0.0);
            for (std::size_t i = 0; i < numbers.size(); ++i)
                largest[i % each] = std::max(largest[i % each], std::fabs(numbers[i]));
            const double rounding = is_read_as_half(*port) ? kRoundingOfHalf : kRoundingOfFloat;
            for (std::uint32_t c = 0; c < port->components; ++c) {
                const double sign = random.one_in(2) ? rounding : -rounding;
                for (std::size_t i = 0; i < each; ++i) numbers[c * each + i] += sign * largest[i];
            }
        }
        moved.count = count;
        return moved;
    }

    [[nodiscard]] bool is_read_as_half(const evaluate::Port& port) const {
        return std::ranges::any_of(program_.infos, [&](const evaluate::OperationInfo& info) {
            return info.is_relaxed && std::ranges::any_of(info.operands, [&](const evaluate::Slice& operand) {
                       return operand.slot < port.slot + port.components &&
                              port.slot < operand.slot + operand.count;
                   });
        });
    }

    /// Bisects each invocation for the first constant or operation with which most of its difference is
    /// there.
    Result<std::vector<LostNumber>> named() {
        Counts without(invocations_.count, 0);
        Counts with(invocations_.count, items_);
        for (std::uint32_t left = items_; left > 1; left = (left + 1) / 2) {
            Counts half(invocations_.count, 0);
            for (const auto& [i, difference] : differences_)
                for (std::size_t pixel = i / together_ * together_; pixel < (i / together_ + 1) * together_;
                     ++pixel)
                    if (pixel < half.size()) half[pixel] = without[i] + (with[i] - without[i]) / 2;
            GOBO_TRY(const Outputs outputs, run_with(invocations_, half));
            for (const auto& [i, difference] : differences_)
                (2 * distance(outputs, i, difference) >= difference.size ? with : without)[i] = half[i];
        }
        std::map<std::uint32_t, LostNumber> lost;
        for (const auto& [i, difference] : differences_) {
            const std::uint32_t operation = operation_of(with[i] - 1);
            const auto [known, is_new] = lost.try_emplace(operation, LostNumber{operation, i, 0, {}});
            ++known->second.points;
        }
        return told(std::move(lost));
    }

    /// The operation, or that which first reads the constant.
    [[nodiscard]] std::uint32_t operation_of(std::uint32_t item) const {
        const auto constants = static_cast<std::uint32_t>(program_.constants.size());
        if (item >= constants) return item - constants;
        const std::uint32_t slot = program_.constants[item].slot;
        const auto reads = [&](const evaluate::OperationInfo& info) {
            return std::ranges::any_of(info.operands, [&](const evaluate::Slice& operand) {
                return operand.slot <= slot && slot < operand.slot + operand.count;
            });
        };
        const auto first = std::ranges::find_if(program_.infos, reads);
        return first == program_.infos.end() ? 0 : static_cast<std::uint32_t>(first - program_.infos.begin());
    }

    Result<std::vector<LostNumber>> told(std::map<std::uint32_t, LostNumber> lost) {
        std::map<std::size_t, std::uint32_t> wanted;
        for (const auto& [operation, one] : lost) wanted[one.invocation] = operation;
        StepRecorder recorder(std::move(wanted));
        GOBO_TRY_DO(evaluate::run<float>(program_, invocations_, options_, &recorder));
        std::vector<LostNumber> result;
        for (auto& [operation, one] : lost) {
            one.text = recorder.text_of(one.invocation) + ", so that " + consequence(one.invocation);
            result.push_back(std::move(one));
        }
        return result;
    }

    /// "c[0] is 0, not 1".
    [[nodiscard]] std::string consequence(std::size_t i) {
        const Difference& at = differences_.at(i);
        if (at.output == nullptr)
            return lossy_.discarded[i] ? "the fragment is discarded" : "the fragment is not discarded";
        return fmt::format("{}[{}] is {}, not {}", at.output->name, at.component,
                           static_cast<float>(value(lossy_, *at.output, at.component, i)),
                           static_cast<float>(value(kept_, *at.output, at.component, i)));
    }

    const Program& program_;
    const evaluate::Invocations& invocations_;
    const evaluate::Options& options_;
    const Outputs& lossy_;
    std::uint32_t items_;                            ///< constants and operations
    std::size_t together_;                           ///< invocations that hang on one another
    Outputs kept_;                                   ///< where small numbers keep their 11 bits
    std::map<std::size_t, Difference> differences_;  ///< by invocation, at most one of a quad
};

}  // namespace

Result<std::vector<LostNumber>> find_lost_numbers(const Program& program,
                                                  const evaluate::Invocations& invocations,
                                                  const evaluate::Options& options, const Outputs& outputs,
                                                  const std::function<bool(std::size_t)>& is_judged) {
    const bool has_half = std::ranges::any_of(program.infos, &evaluate::OperationInfo::is_relaxed);
    if (!has_half || invocations.count == 0) return std::vector<LostNumber>{};
    return Comparison(program, invocations, options, outputs).run(is_judged);
}

}  // namespace gobo::sanitize
