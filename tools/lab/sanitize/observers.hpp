// Watches a run: every operation for traps, and how near it comes to the goals of a guided search.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lab/sanitize/definedness.hpp"
#include "lab/sanitize/rules.hpp"

namespace gobo::sanitize {

/// The nearest that anything came to a goal so far.
struct Reach {
    float distance = std::numeric_limits<float>::infinity();
    std::uint64_t run = 0;       ///< in which that was
    std::size_t invocation = 0;  ///< of that run

    [[nodiscard]] bool is_reached() const { return distance == 0; }
};

/// To be used for run after run of the same program.
class ReachObserver {
  public:
    explicit ReachObserver(const evaluate::Program& program);

    void begin_run() { ++run_; }
    void after(const evaluate::Step<float>& step);

    /// Of each goal.
    [[nodiscard]] const std::vector<Reach>& reaches() const { return reaches_; }
    /// Goals that the current run came nearer to than any before.
    [[nodiscard]] std::vector<std::size_t> advanced() const;

  private:
    /// What an operation is measured for: goals of the rules, then the one of its size.
    struct Watch {
        std::span<const GoalRule> rules;
        bool may_overflow = false;
        std::size_t first_goal = 0;
    };
    void keep_nearest(const evaluate::Step<float>& step, const Distances& distances, Reach& reach) const;

    std::vector<Watch> watches_;  ///< of each operation
    std::vector<Reach> reaches_;
    std::uint64_t run_ = 0;
};

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

/// Cheap where no trap happens: whole rows of lanes are screened, and only suspicious ones looked at.
class TrapObserver final : public evaluate::Observer<float> {
  public:
    /// `reach`, unless it is null, sees every step too.
    explicit TrapObserver(const evaluate::Program& program, ReachObserver* reach = nullptr);

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
    /// How an operation is watched.
    struct Watch {
        std::span<const TrapRule> rules;
        bool has_silent = false;
        bool makes_floats = false;  ///< the result must be finite
    };

    void begin_batch(std::size_t first_invocation);
    void judge(const evaluate::Step<float>& step, const Watch& watch);
    void judge_result(const evaluate::Step<float>& step, const Watch& watch, Lanes lanes);
    void add(const evaluate::Step<float>& step, std::string_view message, Lanes lanes);
    void mark_trapped(Lanes lanes);

    const evaluate::Program& program_;
    std::vector<Watch> watches_;  ///< of each operation
    Definedness definedness_;
    ReachObserver* reach_;
    bool is_in_batch_ = false;
    std::size_t batch_ = 0;  ///< its first invocation
    std::map<std::pair<std::uint32_t, std::string_view>, Hit> hits_;
    std::vector<Unwritten> unwritten_;
    std::vector<Lanes> trapped_;  ///< of each batch up to the last in which anything trapped
};

}  // namespace gobo::sanitize
