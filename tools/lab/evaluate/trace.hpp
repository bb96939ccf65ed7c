// Every operation of one invocation, with its place and values: what `--trace` prints.
#pragma once

#include <string>
#include <vector>

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
    [[nodiscard]] TracedValue value_of(const Step<T>& step, const Slice& slice, std::size_t lane) const;

    std::size_t invocation_;
    std::vector<TraceStep> steps_;
};

extern template class Trace<float>;
extern template class Trace<double>;

/// One line for each step, under a line for each place.
[[nodiscard]] std::string to_text(const std::vector<TraceStep>& steps);

/// A number in the shortest decimal that stands for it (in fp32 where it is an fp32 number: 0.1); several as
/// "(1, 0.5, 0.25)".
[[nodiscard]] std::string to_text(const std::vector<double>& components);

}  // namespace gobo::evaluate
