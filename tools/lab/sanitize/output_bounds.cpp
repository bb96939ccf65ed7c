#include "lab/sanitize/output_bounds.hpp"

#include <algorithm>
#include <limits>

#include "lab/sanitize/lit_bounds.hpp"

namespace gobo::sanitize {
namespace {

/// Of a length, each component is within it.
Interval interval_of(const Domain& domain) {
    Interval interval{domain.of_length ? -domain.high : domain.low, domain.high};
    for (const double also : domain.also) {
        interval.low = std::min(interval.low, also);
        interval.high = std::max(interval.high, also);
    }
    return interval;
}

}  // namespace

OutputBounds::OutputBounds(const Family& family, const Key& key, StageKind stage,
                           const evaluate::Program& program, const InputSpace& space, DepthPromise promise)
    : model_(lit_bounds(family, key, stage, program, space)), promise_(promise) {
    for (const evaluate::Port& output : program.outputs) {
        Interval interval;
        if (output.name == "gl_FragDepth") {
            interval = {0, 1};
            depth_ = declared_.size();
        }
        const auto domain = std::find_if(family.domains.begin(), family.domains.end(),
                                         [&](const Domain& one) { return one.name == output.name; });
        // A varying's domain is what the fragment stage may be given; what a vertex stage makes of matrices
        // within theirs can be anything.
        if (stage == StageKind::fragment && domain != family.domains.end()) interval = interval_of(*domain);
        declared_.insert(declared_.end(), output.components, interval);
    }
    for (const InputField& field : space.fields)
        if (field.name == "gl_FragCoord") own_depth_ = field.first + 2;
}

void OutputBounds::keep_promise(double own_depth, Interval& depth) const {
    // A machine that flushes denormal numbers reads 0 for one.
    const double seen = own_depth < std::numeric_limits<float>::min() ? 0 : own_depth;
    if (promise_ == DepthPromise::greater || promise_ == DepthPromise::unchanged) depth.low = seen;
    if (promise_ == DepthPromise::less || promise_ == DepthPromise::unchanged) depth.high = own_depth;
}

std::vector<Interval> OutputBounds::at(const PointSet& points) {
    std::vector<Interval> intervals;
    intervals.reserve(points.count() * declared_.size());
    for (std::size_t i = 0; i < points.count(); ++i) {
        intervals.insert(intervals.end(), declared_.begin(), declared_.end());
        const auto here = std::span(intervals).last(declared_.size());
        if (model_) model_->narrow(points[i], here);
        if (depth_ && own_depth_) keep_promise(points[i][*own_depth_], here[*depth_]);
    }
    return intervals;
}

}  // namespace gobo::sanitize
