// Watches every operation of a stage for traps. Cheap where none happens: whole rows of lanes are screened,
// and only suspicious ones looked at.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/sanitize/definedness.hpp"
#include "lab/sanitize/trap_rules.hpp"

namespace gobo::sanitize {

/// One trap at one operation, over all invocations of a run.
struct Hit {
    std::uint64_t invocations = 0;
    std::size_t first = 0;  ///< the first invocation that showed it
    std::string operation;  ///< there: "FDiv 1, depth = 0 -> inf"
};

/// An invocation left some component of an output unwritten.
struct Unwritten {
    std::size_t first_invocation = 0;  ///< of lane 0
    std::size_t output = 0;            ///< index into Program::outputs
    Lanes lanes = 0;
};

class TrapObserver final : public evaluate::Observer<float> {
  public:
    explicit TrapObserver(const evaluate::Program& program);

    void after(const evaluate::Step<float>& step) override;
    void clamped(const evaluate::Step<float>& step, std::size_t lane, std::int64_t index,
                 std::uint32_t extent) override;
    /// To be called when the run is over.
    void finish();

    /// Whether the invocation met a trap.
    [[nodiscard]] bool trapped(std::size_t invocation) const {
        const std::size_t batch = invocation / evaluate::kLanes;
        return batch < trapped_.size() && (trapped_[batch] >> invocation % evaluate::kLanes & 1U) != 0;
    }
    /// By operation and message.
    [[nodiscard]] const std::map<std::pair<std::uint32_t, std::string_view>, Hit>& hits() const {
        return hits_;
    }
    /// Of every batch; discarded invocations among them.
    [[nodiscard]] const std::vector<Unwritten>& unwritten() const { return unwritten_; }

  private:
    /// How an operation is watched: indices into trap_rules(), and whether its result must be finite.
    struct Watch {
        std::uint32_t first_rule = 0;
        std::uint32_t rules = 0;
        bool has_silent = false;
        bool makes_reals = false;
    };
    [[nodiscard]] static Watch watch_of(const evaluate::Program& program, std::uint32_t operation);

    void begin_batch(std::size_t first_invocation);
    void judge(const evaluate::Step<float>& step, const Watch& watch);
    void judge_result(const evaluate::Step<float>& step, const Watch& watch, Lanes lanes);
    void add(const evaluate::Step<float>& step, std::string_view message, Lanes lanes);
    void mark_trapped(Lanes lanes);

    const evaluate::Program& program_;
    std::vector<Watch> watches_;  ///< of each operation
    Definedness definedness_;
    bool is_in_batch_ = false;
    std::size_t batch_ = 0;  ///< its first invocation
    std::map<std::pair<std::uint32_t, std::string_view>, Hit> hits_;
    std::vector<Unwritten> unwritten_;
    std::vector<Lanes> trapped_;  ///< of each batch up to the last in which anything trapped
};

}  // namespace gobo::sanitize
