// One stage of a composition searched, portion by portion, at hard points and at points made of what earlier
// ones reached.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "lab/sanitize/finding.hpp"
#include "lab/sanitize/hard_points.hpp"

namespace gobo::sanitize {

/// Chooses points by what earlier ones reached: remembers for each goal the point that came nearest to it. A
/// fresh portion holds changed copies of these, most for goals that are not reached and whose copies still
/// advance, and some points from nowhere.
class Guide {
  public:
    Guide(const evaluate::Program& program, const InputSpace& space, std::uint64_t seed);

    /// To be given to the run of the points that learn() is told of.
    [[nodiscard]] ReachObserver& observer() { return observer_; }
    void begin_run() { observer_.begin_run(); }
    void learn(const PointSet& points);

    [[nodiscard]] PointSet next(std::size_t count);

  private:
    struct Goal {
        std::vector<double> point;   ///< that came nearest; empty where none came near
        std::size_t changed = 0;     ///< the number whose change brought it there
        std::uint64_t failures = 0;  ///< copies since then
    };
    [[nodiscard]] std::size_t pick_goal();

    const InputSpace& space_;
    ReachObserver observer_;
    Random random_;
    PointChanger changer_;
    std::vector<Goal> goals_;
    std::vector<std::size_t> known_;         ///< goals with a point
    std::vector<std::size_t> last_changed_;  ///< of each point of the last portion
    std::uint64_t seed_;
};

/// What makes two findings the same: file, line, message.
using Signature = std::tuple<std::string, int, std::string>;
[[nodiscard]] Signature signature_of(const Finding& finding);

/// Points are made and run in portions, so that they stay in the cache and their rows are not mapped anew
/// each time.
inline constexpr std::size_t kPortion = 256;

class StageSearch {
  public:
    /// `key` is any of those that share the stage.
    StageSearch(const Family& family, const Key& key, StageKind kind, evaluate::Program program,
                DepthPromise promise, std::vector<Machine> machines);
    StageSearch(const StageSearch&) = delete;
    StageSearch& operator=(const StageSearch&) = delete;

    /// Runs the points on every machine, and keeps what is found.
    [[nodiscard]] Result<void> run(const PointSet& points);
    /// Makes `count` points out of what earlier ones reached, and runs them. From the first call of
    /// guide_from() on, every run teaches.
    [[nodiscard]] Result<void> run_guided(std::size_t count) { return run(guide_->next(count)); }
    void guide_from(std::uint64_t seed) { guide_ = std::make_unique<Guide>(program_, space_, seed); }

    /// A finding of this stage with every input that does not matter turned into a simple value of its domain
    /// (0, 1, a unit vector, the identity, few digits) while it stays at its place with its message. Where it
    /// needs its neighbour pixels, it is given back as it is.
    [[nodiscard]] Finding simplified(const Finding& finding);

    [[nodiscard]] const InputSpace& space() const { return space_; }
    [[nodiscard]] const std::map<Signature, Finding>& findings() const { return findings_; }
    [[nodiscard]] std::uint64_t points() const { return points_; }

  private:
    StageKind kind_;
    evaluate::Program program_;
    InputSpace space_;
    OutputBounds bounds_;
    std::vector<Machine> machines_;
    std::map<Signature, Finding> findings_;
    std::unique_ptr<Guide> guide_;  ///< null where nothing is to be learnt
    std::uint64_t points_ = 0;
};

}  // namespace gobo::sanitize
