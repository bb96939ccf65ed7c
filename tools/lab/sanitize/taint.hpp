// Which values are undefined, and by what cause: what is computed from them is no new fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lab/sanitize/trap_rules.hpp"

namespace gobo::sanitize {

/// Why a value is undefined.
struct Cause {
    enum class Kind {
        none,
        unwritten,  ///< a variable that nothing has written
        no_return,  ///< a function that ended without one
        constant,   ///< a constant that is no finite number
        trap,       ///< an operation that has been told of
    };
    Kind kind = Kind::none;
    std::size_t index = 0;  ///< of Program::variables, of Program::undefined, of the caller's traps
};

/// Follows undefined values through everything that is computed from them, lane by lane. Copying one is fine,
/// as a vector that is filled component by component is copied half empty, and so is computing with one, as
/// long as nothing comes of it: what matters is told by `reached()`.
class Taint {
  public:
    explicit Taint(const evaluate::Program& program);

    /// Nothing is written yet.
    void begin();
    /// To be called after each step.
    void after(const evaluate::Step<float>& step);
    void copied(const evaluate::Operation& copy, Lanes lanes);
    /// The step's result is undefined in these lanes from here on.
    void mark(const evaluate::Step<float>& step, Lanes lanes, const Cause& cause);

    /// The lanes in which some component of the slots is undefined.
    [[nodiscard]] Lanes lanes_of(std::uint32_t slot, std::uint32_t count) const;
    [[nodiscard]] Lanes lanes_of(const evaluate::Slice& slice) const {
        return lanes_of(slice.slot, slice.count);
    }
    /// The cause of the first component that is undefined in the lane.
    [[nodiscard]] const Cause& cause_of(std::uint32_t slot, std::uint32_t count, std::size_t lane) const;
    /// The lanes in which an operand of the step is undefined. To be asked before after().
    [[nodiscard]] Lanes operands_of(const evaluate::Step<float>& step) const;
    /// The cause of the first operand that is undefined in the lane.
    [[nodiscard]] const Cause& operand_cause(const evaluate::Step<float>& step, std::size_t lane) const;

    /// The lanes in which the last step computed with a value that nobody wrote.
    [[nodiscard]] Lanes used() const { return used_; }
    /// The operation that first computed with the cause in this lane; nothing where it was only copied.
    [[nodiscard]] std::optional<std::uint32_t> first_use(const Cause& cause, std::size_t lane) const;

  private:
    using CauseId = std::uint32_t;

    void move(const evaluate::Step<float>& step, const evaluate::Operation& operation);
    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, Lanes lanes);
    void gather(const evaluate::Step<float>& step, const evaluate::Operation& operation);
    void select(const evaluate::Step<float>& step, const evaluate::Operation& operation);
    void compute(const evaluate::Step<float>& step);
    Lanes decided_by_other(const evaluate::Step<float>& step);
    void note_use(const evaluate::Step<float>& step, Lanes lanes);
    void compute_address(const evaluate::Operation& operation, const evaluate::Step<float>& step);
    [[nodiscard]] CauseId id_of(const Cause& cause);
    [[nodiscard]] Lanes conditions(const evaluate::Step<float>& step, const evaluate::Slice& condition,
                                   std::uint32_t component) const;

    /// What is known of a slot: lanes of one cause, and others of a second. A third counts as the second,
    /// unless only that one has been told of already: a trap is never taken for a value that nobody wrote.
    struct State {
        Lanes lanes = 0;
        Lanes others = 0;  ///< of `lanes`, those of the other cause
        CauseId cause = 0;
        CauseId other_cause = 0;

        [[nodiscard]] CauseId cause_in(std::size_t lane) const {
            return (others >> lane & 1U) != 0 ? other_cause : cause;
        }
        [[nodiscard]] State within(Lanes some) const {
            if ((lanes & some & ~others) == 0) return {lanes & some, 0, other_cause, 0};  // room for another
            return {lanes & some, others & some, cause, other_cause};
        }
        /// Adds the lanes that are not known yet. Causes from `told` on are traps.
        void add(const State& more, CauseId told);
    };
    const evaluate::Program& program_;
    std::vector<State> states_;   ///< of each slot
    std::vector<State> scratch_;  ///< an operation's result may share slots with its operands
    Lanes used_ = 0;
    std::vector<Cause> causes_;  ///< by id; 0 is none
    CauseId fixed_causes_ = 0;   ///< ids below are of variables, undefined values and constants
    std::vector<std::vector<std::uint32_t>> first_uses_;  ///< by id: of each lane an operation plus 1, or 0
};

}  // namespace gobo::sanitize
