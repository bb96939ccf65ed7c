// What is wrong with the outputs of a run: unwritten, or beyond what the inputs allow.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/sanitize/finding.hpp"
#include "lab/sanitize/taint.hpp"

namespace gobo::sanitize {

/// One stage run on one machine.
struct Run {
    const evaluate::Program& program;
    const evaluate::Invocations& invocations;
    Machine machine;

    /// Fills a finding in at the first invocation that showed it. `at` is the operation where it happens.
    void show(Finding& finding, std::string_view message, std::string text, std::size_t invocation,
              std::optional<std::uint32_t> at) const {
        finding.message = message;
        finding.operation = std::move(text);
        finding.machine = machine;
        if (at) finding.place = program.place_of(*at);
        finding.point = point_of(program, invocations, invocation);
        if (machine != Machine::ieee) finding.point.machine = name_of(machine);
    }
};

/// Lanes of a batch in which a component of an output is undefined.
struct UndefinedOutput {
    std::size_t first_invocation = 0;  ///< of lane 0
    std::size_t output = 0;            ///< index into written_ports()
    std::uint32_t component = 0;       ///< the first that is undefined
    Lanes lanes = 0;
    Cause cause;
    std::optional<std::uint32_t> first_use;  ///< the operation that first computed with it
    bool is_unwritten = false;               ///< the output itself was not written
};

/// What an observer saw of a run, by invocation.
struct Observed {
    std::span<const UndefinedOutput> undefined;
    std::function<bool(std::size_t)> is_trapped;
    /// Whether an output comes of a constant that is no finite number.
    std::function<bool(std::size_t)> is_of_constants;
};

/// The operation that last stores to the output, or to an array by an index that may lead to it; nothing
/// where none does.
[[nodiscard]] std::optional<std::uint32_t> last_store(const evaluate::Program& program,
                                                      const evaluate::Port& port);
/// Outputs of OpenGL's own may be left alone, and vertex outputs that the fragment stage does not read.
[[nodiscard]] bool must_be_written(const evaluate::Program& program, const evaluate::Port& port);
/// The outputs, and what storage blocks and counters hold.
[[nodiscard]] std::vector<const evaluate::Port*> written_ports(const evaluate::Program& program);

/// Outputs that some invocation leaves unwritten, and those beyond `bounds`, unless they are empty, at points
/// that write them and do not trap; of no discarded one.
[[nodiscard]] std::vector<Finding> output_findings(const Run& run, const evaluate::Outputs& outputs,
                                                   const Observed& observed,
                                                   std::span<const Interval> bounds);

}  // namespace gobo::sanitize
