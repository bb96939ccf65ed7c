// One permutation on one scene: its error by cause, in linear radiance, and the operations it executes.
#pragma once

#include "lab/study/points.hpp"

namespace gobo::study {

/// How far one picture is from another, over all points but those at a discontinuity.
struct ErrorFigures {
    double max = 0;   ///< largest absolute error of a channel
    double p999 = 0;  ///< 99.9 % of the points have no channel with a larger one
    double rms = 0;   ///< root mean square over the channels

    friend bool operator==(const ErrorFigures&, const ErrorFigures&) = default;
};
/// Of a point of a curve: the model's, then the total.
using CurveErrors = std::array<ErrorFigures, 2>;

/// Colours of a scene's points, object by object.
using Colors = std::vector<std::vector<Color>>;
[[nodiscard]] Colors reference_colors(const ScenePoints& points);

/// NaN is an infinite error.
[[nodiscard]] ErrorFigures error_between(const ScenePoints& points, const Colors& actual,
                                         const Colors& expected);

/// Three causes are told apart. The total is what fp32 gives against the reference.
struct Measurement {
    ErrorFigures total;
    ErrorFigures rounding;       ///< fp32 against fp64 of the same permutation
    ErrorFigures approximation;  ///< fp64 at full shading rate against the reference
    ErrorFigures rate;           ///< fp64 against fp64 at full shading rate
    double relative = 0;         ///< largest relative error of the total
    raster::Work work;
    std::size_t pixels = 0;
    std::size_t edges = 0;
    std::size_t shown_vertices = 0;  ///< work.vertices is theirs
    std::size_t mesh_vertices = 0;
    bool from_oracle = false;
};

/// `at_full_rate` differs from the variant only in the features that say where light is computed; it may be
/// the variant itself.
[[nodiscard]] Result<Measurement> measure(const ScenePoints& points, const Variant& variant,
                                          const Variant& at_full_rate);

/// The colours of a variant at the points, in arithmetic of T.
template <class T>
[[nodiscard]] Result<Colors> shade_points(const ScenePoints& points, const Variant& variant,
                                          raster::Work* work = nullptr);

}  // namespace gobo::study
