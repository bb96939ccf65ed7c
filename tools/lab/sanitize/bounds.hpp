// What the outputs of a stage may hold, point by point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/sanitize/input_space.hpp"

namespace gobo::sanitize {

/// What a fragment stage promises of the depth that it writes (ARB_conservative_depth, GLSL 4.20): the
/// written depth against gl_FragCoord.z: `layout(depth_greater) out float gl_FragDepth` and its like.
enum class DepthPromise { none, greater, less, unchanged };

/// That of a SPIR-V module; `none` where it has none, or is none.
[[nodiscard]] DepthPromise depth_promise_of(std::span<const std::uint32_t> spirv);

/// The low end of what has to be above 0.
inline constexpr double kLeastAboveZero = std::numeric_limits<float>::denorm_min();

/// Both ends belong to it.
struct Interval {
    double low = -static_cast<double>(std::numeric_limits<float>::max());
    double high = static_cast<double>(std::numeric_limits<float>::max());
    DepthPromise promise = DepthPromise::none;  ///< which made gl_FragCoord.z one of the ends, or both
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

    /// One interval of each component of each output, for each invocation of each point, one after the other.
    [[nodiscard]] std::vector<Interval> at(const PointSet& points);

  private:
    void keep_promise(double own_depth, Interval& depth) const;

    std::vector<Interval> declared_;
    /// Narrows a pixel's intervals to what its model allows; nothing where there are no equations.
    std::function<void(std::span<const double> point, int pixel, std::span<Interval>)> narrow_;
    std::size_t pixels_ = 1;  ///< of a point
    DepthPromise promise_;
    /// Index of gl_FragDepth's interval; nothing where the stage writes none.
    std::optional<std::size_t> depth_;
    /// Indices of each pixel's gl_FragCoord.z in a point; none where the stage does not read it.
    std::vector<std::size_t> own_depths_;
};

}  // namespace gobo::sanitize
