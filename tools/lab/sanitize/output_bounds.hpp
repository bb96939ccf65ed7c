// What the outputs of a stage may hold, point by point.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/sanitize/depth_promise.hpp"
#include "lab/sanitize/input_space.hpp"

namespace gobo::sanitize {

/// Both ends belong to it.
struct Interval {
    double low = -static_cast<double>(std::numeric_limits<float>::max());
    double high = static_cast<double>(std::numeric_limits<float>::max());
};

/// A stage of a family with equations of its own.
class ModelBounds {
  public:
    ModelBounds() = default;
    ModelBounds(const ModelBounds&) = delete;
    ModelBounds& operator=(const ModelBounds&) = delete;
    virtual ~ModelBounds() = default;
    /// Narrows the intervals, one of each component of each output in the program's order.
    virtual void narrow(std::span<const double> point, std::span<Interval> intervals) = 0;
};

/// Every output is finite. A fragment stage's stay within the domain that the family declares for them by
/// name, its depth within [0, 1] and, where it reads gl_FragCoord, on the side of gl_FragCoord.z that it
/// promises. Where the oracle knows the key's model, they are as the model allows: no radiance is negative or
/// more than the sum of all terms with every angle's share taken as 1.
class OutputBounds {
  public:
    /// `program` and `space` must outlive the bounds.
    OutputBounds(const Family& family, const Key& key, StageKind stage, const evaluate::Program& program,
                 const InputSpace& space, DepthPromise promise);

    /// How many intervals a point has: one of each component of each output.
    [[nodiscard]] std::size_t components() const { return declared_.size(); }
    /// components() intervals of each point, one point after the other.
    [[nodiscard]] std::vector<Interval> at(const PointSet& points);

  private:
    void keep_promise(double own_depth, Interval& depth) const;

    std::vector<Interval> declared_;
    std::unique_ptr<ModelBounds> model_;  ///< null where there are no equations
    DepthPromise promise_;
    /// Index of gl_FragDepth's interval; nothing where the stage writes none.
    std::optional<std::size_t> depth_;
    /// Index of gl_FragCoord.z in a point; nothing where the stage does not read it.
    std::optional<std::size_t> own_depth_;
};

}  // namespace gobo::sanitize
