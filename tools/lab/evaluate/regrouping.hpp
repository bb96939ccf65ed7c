// Machines that compute sums otherwise than written, as compilers of GLSL may. Internal to evaluation.
#pragma once

#include <vector>

#include "lab/evaluate/machine.hpp"

namespace gobo::evaluate {

/// Remembers of each slot and lane of which two numbers its value is the product (fused) or the sum
/// (regrouped, reordered), wherever it has been copied since, and computes later additions from those:
/// across variables, calls and turns of loops, as a compiler sees them once it has inlined and unrolled all.
/// Neither what `precise` marks is regrouped, nor the parts of what it marks.
template <class T>
class Regrouping {
  public:
    Regrouping(const Program& program, Machine<T>& machine, Sums sums);

    /// Nothing is known of any slot.
    void begin();
    /// Computes the operation, of index `at`, where it is an addition whose parts are known. False: the
    /// operation is to be run as always, and after() to be called.
    [[nodiscard]] bool takes_over(std::uint32_t at);
    void after(std::uint32_t at);
    /// A masked copy has been made.
    void keep(const Operation& operation);

  private:
    struct Parts {
        T first;
        T second;
    };
    [[nodiscard]] Parts* parts(std::uint32_t slot) { return parts_.data() + std::size_t{slot} * kLanes; }
    void remember(const Operation& operation, bool is_scaled);
    void negate(const Operation& operation);
    void forget(std::uint32_t slot, std::uint32_t count);
    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, LaneMask lanes);
    void add(const Operation& operation, bool is_difference);
    void add_lane(const Operation& operation, std::uint32_t component, std::size_t lane, T sign);
    [[nodiscard]] Parts regroup(Parts known, T other, T& sum) const;
    void move(const Operation& operation, std::uint32_t code);

    const Program& program_;
    Machine<T>& machine_;
    Sums sums_;
    std::vector<Parts> parts_;     ///< of each slot and lane
    std::vector<LaneMask> known_;  ///< of each slot: lanes with parts
};

extern template class Regrouping<float>;
extern template class Regrouping<double>;

}  // namespace gobo::evaluate
