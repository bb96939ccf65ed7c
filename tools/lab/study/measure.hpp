// One permutation on one scene: its error by cause, in linear radiance, the operations it executes, and what
// they cost on a renderer.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
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
struct Measurement : PointCounts {
    ErrorFigures total;
    ErrorFigures rounding;       ///< fp32 against fp64 of the same permutation
    ErrorFigures approximation;  ///< fp64 at full shading rate against the reference
    ErrorFigures rate;           ///< fp64 against fp64 at full shading rate
    double relative = 0;         ///< largest relative error of the total
    raster::Work work;           ///< of the shown vertices, and the pixels
};

/// `at_full_rate` differs from the variant only in the features that say where light is computed; it may be
/// the variant itself.
[[nodiscard]] Result<Measurement> measure(const ScenePoints& points, const Variant& variant,
                                          const Variant& at_full_rate);

/// The colours of a variant at the points, in arithmetic of T.
template <class T>
[[nodiscard]] Result<Colors> shade_points(const ScenePoints& points, const Variant& variant,
                                          raster::Work* work = nullptr);

/// A number for each kind of operation.
using ByKind = std::array<double, evaluate::kKinds>;

/// Weights of one renderer. The unit is one addition of floats.
struct Weights {
    std::string renderer;    ///< GL_RENDERER
    double nanoseconds = 0;  ///< of one unit, for one invocation
    ByKind by_kind{};
};

/// Columns renderer, kind, weight, nanoseconds. Errors: a missing column or kind, a number that is none; at
/// `path` and the line.
[[nodiscard]] Result<std::vector<Weights>> read_weights(std::string_view csv, const std::string& path);
[[nodiscard]] std::string weights_csv(const std::vector<Weights>& weights);

/// The operations of one fragment, of one vertex, and of a fragment with its part of the vertices, in the
/// weights' unit.
struct Costs {
    double fragment = 0;
    double vertex = 0;
    double vertices_per_fragment = 0;  ///< in a picture of kFullWidth x kFullHeight
    double total = 0;
};

[[nodiscard]] Costs costs_of(const Measurement& measurement, const Weights& weights);

[[nodiscard]] double weighted(const evaluate::Counts& counts, const Weights& weights);

}  // namespace gobo::study
