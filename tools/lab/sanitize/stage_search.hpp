// One stage of a composition, searched portion by portion.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "lab/sanitize/find_traps.hpp"
#include "lab/sanitize/guide.hpp"
#include "lab/sanitize/output_bounds.hpp"
#include "lab/sanitize/shrink.hpp"

namespace gobo::sanitize {

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
    [[nodiscard]] Result<bool> run(const PointSet& points);
    /// Makes `count` points out of what earlier ones reached, and runs them. From the first call of
    /// guide_from() on, every run teaches.
    [[nodiscard]] Result<bool> run_guided(std::size_t count) { return run(guide_->next(count)); }
    void guide_from(std::uint64_t seed) { guide_ = std::make_unique<Guide>(program_, space_, seed); }

    /// The finding of this stage at a simpler input.
    [[nodiscard]] Finding simplified(const Finding& finding) {
        return shrunk(program_, space_, bounds_, finding);
    }

    [[nodiscard]] const InputSpace& space() const { return space_; }
    [[nodiscard]] const std::map<Signature, Finding>& findings() const { return findings_; }
    [[nodiscard]] std::uint64_t points() const { return points_; }

  private:
    void merge(std::map<Signature, Finding> found);

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
