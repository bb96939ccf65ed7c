// What `gobo eval` answers: one invocation in fp32 and fp64, side by side, and every operation of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// A value as an operation read or wrote it.
struct TracedValue {
    std::string name;  ///< "lights[0].color"; empty where the source gives it none
    std::vector<double> components;

    friend bool operator==(const TracedValue&, const TracedValue&) = default;
};

struct TraceStep {
    Place place;
    std::string operation;  ///< "FMul"
    TracedValue result;
    std::vector<TracedValue> operands;  ///< none of a load: its result tells
};

/// Records the steps of one invocation, in the order they are executed.
template <class T>
class Trace final : public Observer<T> {
  public:
    explicit Trace(std::size_t invocation = 0) : invocation_(invocation) {}
    void after(const Step<T>& step) override;
    void clamped(const Step<T>& step, std::size_t lane, std::int64_t index, std::uint32_t extent) override;
    [[nodiscard]] const std::vector<TraceStep>& steps() const { return steps_; }

  private:
    std::size_t invocation_;
    std::vector<TraceStep> steps_;
};

extern template class Trace<float>;
extern template class Trace<double>;

/// Line `place.line` of the text that `place.file` names; empty where that is unknown.
using SourceLine = std::function<std::string(const Place& place)>;

/// One line for each step, under a line for each place with the source there.
[[nodiscard]] std::string to_text(
    const std::vector<TraceStep>& steps,
    const SourceLine& source_line = [](const Place&) { return std::string(); });

/// A number in the shortest decimal that stands for it (in fp32 where it is an fp32 number: 0.1); several as
/// "(1, 0.5, 0.25)".
[[nodiscard]] std::string to_text(const std::vector<double>& components);

struct EvalOutput {
    std::string name;
    std::string type;  ///< GLSL name
    std::vector<double> in_float;
    std::vector<double> in_double;
    bool is_written = false;  ///< a texel, or what a storage block or counter holds in the end
    bool is_wide = false;     ///< of 64 bits
};

struct EvalReport {
    std::vector<EvalOutput> outputs;  ///< sorted by name; then what has been written besides, if it differs
    bool is_discarded_in_float = false;
    bool is_discarded_in_double = false;
    Counts counts{};               ///< in fp32
    std::vector<TraceStep> trace;  ///< in fp32; empty unless asked for
};

/// How one invocation is run.
struct EvalOptions {
    bool with_trace = false;
    Options arithmetic = {};     ///< of fp32
    std::size_t invocation = 0;  ///< the one that is told of
};

/// Runs the invocations in both arithmetics, and tells of one.
[[nodiscard]] Result<EvalReport> evaluate_once(const Program& program, const Invocations& invocations,
                                               const EvalOptions& options);

/// The trace (with the source line above the operations it consists of), outputs, differences and counts.
[[nodiscard]] std::string to_text(const EvalReport& report, const SourceLine& source_line);

/// The same as JSON. What JSON has no number for is a string: "nan", "inf", "-inf".
[[nodiscard]] nlohmann::ordered_json to_json(const EvalReport& report);

}  // namespace gobo::evaluate
