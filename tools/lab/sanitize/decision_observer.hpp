// Tells whether two evaluations of a point decided alike.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

/// A number for all that an invocation decided: every comparison, and every step from reals to whole numbers.
/// Where it is the same in fp32 and fp64, what the outputs differ by is rounding; otherwise one of them may
/// stand on the other side of a jump.
template <class T>
class DecisionObserver final : public evaluate::Observer<T> {
  public:
    DecisionObserver(const evaluate::Program& program, std::size_t invocations);
    void after(const evaluate::Step<T>& step) override;
    [[nodiscard]] std::uint64_t of(std::size_t invocation) const { return decided_[invocation]; }

  private:
    std::vector<bool> decides_;  ///< of each operation
    std::vector<std::uint64_t> decided_;
};

}  // namespace gobo::sanitize
