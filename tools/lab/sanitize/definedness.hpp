// Which values hold something that was never written, lane by lane.
#pragma once

#include <vector>

#include "lab/sanitize/rules.hpp"

namespace gobo::sanitize {

/// Follows unwritten values through loads, stores and the parts of composites. Copying one is fine, as a
/// vector that is filled component by component is copied half empty; computing with one is not.
class Definedness {
  public:
    explicit Definedness(const evaluate::Program& program);

    /// Nothing is written yet.
    void begin();
    /// To be called after each step. The lanes in which it computed with a value that was never written.
    [[nodiscard]] Lanes after(const evaluate::Step<float>& step);
    /// The lanes in which some component of the slots is unwritten.
    [[nodiscard]] Lanes undefined_in(std::uint32_t slot, std::uint32_t count) const;

  private:
    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, Lanes lanes);
    void gather(const evaluate::Step<float>& step, const evaluate::Operation& operation);
    [[nodiscard]] Lanes move(const evaluate::Step<float>& step, const evaluate::Operation& operation);
    [[nodiscard]] Lanes compute(const evaluate::Step<float>& step);

    const evaluate::Program& program_;
    std::vector<Lanes> undefined_;          ///< of each slot
    std::vector<Lanes> scratch_;            ///< an operation's result may share slots with its operands
    std::vector<std::uint32_t> followers_;  ///< of each operation: unobserved copies directly behind it
};

}  // namespace gobo::sanitize
