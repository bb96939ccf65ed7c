#include "lab/prove/check.hpp"

#include <map>
#include <set>

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/functions.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/finding.hpp"
#include "lab/sanitize/hard_points.hpp"

namespace gobo::prove {
namespace {

using evaluate::kLanes;
using Step = evaluate::Step<float>;

/// Points run together: a variant of arithmetic for each portion.
constexpr std::size_t kPortion = 256;

bool holds(const Range& range, double number) {
    if (std::isnan(number)) return range.nan;
    // On the variant that flushes them, denormals are what operations take for 0.
    if (std::fabs(number) < kSmallestNormal && range.holds_zero()) return true;
    return number >= range.low && number <= range.high && std::fabs(number) >= range.least &&
           (number != 0 || range.zero);
}

/// Compares what every operation gives with what it was proven to give.
class Watcher final : public evaluate::Observer<float> {
  public:
    Watcher(const evaluate::Program& program, const std::vector<std::vector<Range>>& results)
        : program_(program), results_(results) {}

    void after(const Step& step) override {
        const std::vector<Range>& results = results_[step.operation];
        if (results.empty() || is_told_.contains(step.operation)) return;
        const evaluate::Slice slice{program_.operations[step.operation].result,
                                    static_cast<std::uint32_t>(results.size()), step.info().result.scalar, 0};
        for (std::uint32_t component = 0; component < slice.count; ++component)
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                if ((step.lanes >> lane & 1U) == 0) continue;
                // Integers as signed ones, as proofs have them.
                evaluate::Slice as_signed = slice;
                const bool is_address =
                    step.row().code == spv::OpAccessChain;  // whose slice is the variable's
                const bool is_exponent = step.row().code == evaluate::kExtended + GLSLstd450FrexpStruct &&
                                         component >= program_.operations[step.operation].count;
                if (slice.scalar == Scalar::uint32 || is_address || is_exponent)
                    as_signed.scalar = Scalar::int32;
                const double number = step.value(as_signed, component, lane);
                if (holds(results[component], number)) continue;
                is_told_.insert(step.operation);
                diagnostics_.push_back(evaluate::error_at(
                    step.place(),
                    fmt::format("the proof is wrong: {} gives {}, proven to lie in [{}, {}]{}", step.name(),
                                number, results[component].low, results[component].high,
                                results[component].zero ? "" : " without 0")));
                return;
            }
    }

    [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }

  private:
    const evaluate::Program& program_;
    const std::vector<std::vector<Range>>& results_;
    std::set<std::uint32_t> is_told_;
    Diagnostics diagnostics_;
};

}  // namespace

Diagnostics check(const evaluate::Program& program, const sanitize::InputSpace& space,
                  const std::vector<RuleAtOperation>& rules, const std::vector<std::vector<Range>>& results,
                  std::size_t points, std::uint64_t seed) {
    using Where = std::tuple<std::string, int, std::string>;
    std::map<Where, bool> is_proven;  // at all operations of a line that the rule is of
    for (const RuleAtOperation& rule : rules) {
        const Place& place = program.place_of(rule.operation);
        const auto [known, is_new] =
            is_proven.try_emplace({place.file, place.line, std::string(rule.rule.message)}, rule.is_proven);
        known->second = known->second && rule.is_proven;
    }
    Watcher watcher(program, results);
    Diagnostics diagnostics;
    std::set<Where> is_told;
    for (std::size_t done = 0; done < points; done += kPortion) {
        const std::size_t portion = done / kPortion;
        const auto set = sanitize::hard_points(space, std::min(kPortion, points - done), seed + portion);
        const sanitize::Machine machine = sanitize::kMachines[portion % sanitize::kMachines.size()];
        const auto found =
            sanitize::find_traps(program, sanitize::invocations_of(space, set), machine, {}, &watcher);
        if (!found) return found.error();
        for (const sanitize::Finding& finding : *found) {
            const Where where{finding.place.file, finding.place.line, finding.message};
            const auto known = is_proven.find(where);
            if (known == is_proven.end() || !known->second || !is_told.insert(where).second) continue;
            diagnostics.push_back(evaluate::error_at(
                finding.place,
                fmt::format("the proof is wrong: proven impossible, yet met: {}", to_text(finding))));
        }
    }
    append(diagnostics, watcher.diagnostics());
    return diagnostics;
}

}  // namespace gobo::prove
