#include "lab/sanitize/stage_search.hpp"

#include <algorithm>
#include <utility>

namespace gobo::sanitize {

Signature signature_of(const Finding& finding) {
    return {finding.place.file, finding.place.line, finding.message};
}

StageSearch::StageSearch(const Family& family, const Key& key, StageKind kind, evaluate::Program program,
                         DepthPromise promise, std::vector<Machine> machines)
    : kind_(kind),
      program_(std::move(program)),
      space_(input_space_of(program_, family.domains)),
      bounds_(family, key, kind, program_, space_, promise),
      machines_(std::move(machines)) {}

Result<bool> StageSearch::run(const PointSet& points) {
    const evaluate::Invocations invocations = invocations_of(space_, points);
    const std::vector<Interval> bounds = bounds_.at(points);
    std::map<Signature, Finding> all;
    for (const Machine machine : machines_) {
        if (guide_) guide_->begin_run();
        Result<std::vector<Finding>> found =
            find_traps(program_, invocations, machine, bounds, guide_ ? &guide_->observer() : nullptr);
        if (!found) return tl::unexpected(found.error());
        if (guide_) guide_->learn(points);
        std::map<Signature, std::uint64_t> on_this_machine;
        for (Finding& finding : *found) on_this_machine[signature_of(finding)] += finding.points;
        for (Finding& finding : *found) all.try_emplace(signature_of(finding), std::move(finding));
        // A point that traps on several machines is still one.
        for (const auto& [signature, count] : on_this_machine)
            all[signature].points = std::max(all[signature].points, count);
    }
    merge(std::move(all));
    points_ += points.count();
    return true;
}

/// The first example is kept.
void StageSearch::merge(std::map<Signature, Finding> found) {
    for (auto& [signature, finding] : found) {
        finding.stage = kind_;
        const auto [known, is_new] = findings_.try_emplace(signature, finding);
        if (!is_new) known->second.points += finding.points;
    }
}

}  // namespace gobo::sanitize
