// What `gobo eval` answers: one invocation in fp32 and fp64, side by side.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "lab/evaluate/evaluate.hpp"
#include "lab/evaluate/trace.hpp"

namespace gobo::evaluate {

struct EvalOutput {
    std::string name;
    std::string type;  ///< GLSL name
    std::vector<double> in_float;
    std::vector<double> in_double;
};

struct EvalReport {
    std::vector<EvalOutput> outputs;  ///< sorted by name
    bool is_discarded_in_float = false;
    bool is_discarded_in_double = false;
    Counts counts{};               ///< in fp32
    std::vector<TraceStep> trace;  ///< in fp32; empty unless asked for
};

/// Runs one invocation in both arithmetics.
[[nodiscard]] Result<EvalReport> evaluate_once(const Program& program, const Invocations& invocations,
                                               bool with_trace);

/// Line `place.line` of the text that `place.file` names; empty where that is unknown.
using SourceLine = std::function<std::string(const Place& place)>;

/// The trace (with the source line above the operations it consists of), outputs, differences and counts.
[[nodiscard]] std::string to_text(const EvalReport& report, const SourceLine& source_line);

/// The same as JSON. What JSON has no number for is a string: "nan", "inf", "-inf".
[[nodiscard]] nlohmann::ordered_json to_json(const EvalReport& report);

}  // namespace gobo::evaluate
