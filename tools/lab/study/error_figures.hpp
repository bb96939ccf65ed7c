// How far one picture is from another, in linear radiance.
#pragma once

#include <vector>

#include "lab/study/scene_points.hpp"

namespace gobo::study {

/// Of all points but those at a discontinuity.
struct ErrorFigures {
    double max = 0;   ///< largest absolute error of a channel
    double p999 = 0;  ///< 99.9 % of the points have no channel with a larger one
    double rms = 0;   ///< root mean square over the channels

    friend bool operator==(const ErrorFigures&, const ErrorFigures&) = default;
};

/// Relative errors count only where the reference exceeds this.
inline constexpr double kLeastRadiance = 1e-3;

/// Colours of a scene's points, object by object.
using Colors = std::vector<std::vector<Color>>;

/// NaN is an infinite error.
[[nodiscard]] ErrorFigures error_between(const ScenePoints& points, const Colors& actual,
                                         const Colors& expected);

/// The largest relative error against the reference.
[[nodiscard]] double relative_error(const ScenePoints& points, const Colors& actual);

[[nodiscard]] Colors reference_colors(const ScenePoints& points);

}  // namespace gobo::study
