// How far a float evaluation of the models may be from the exact answer: a bound derived from the inputs'
// condition and the number of operations. docs/verification.md has the derivation in full.
#pragma once

#include "lab/oracle/oracle.hpp"

namespace gobo::verify {

/// The unit roundoff of a float: each operation is off by at most this, relative to its result.
inline constexpr double kUnitRoundoff = 0x1p-24;

/// Errors that the surface point already has, in a vertex stage from its transformation.
struct PointErrors {
    double position = 0;  ///< length of the error vector
    double normal = 0;    ///< relative
};

/// Direction of a vector by scaling, a dot product, a reciprocal square root and two products: at most 6
/// roundings of each component (1 + 1.5 + 2 + 1, rounded up).
inline constexpr double kDirectionError = 6 * kUnitRoundoff;

/// Bound of each channel's error of lit_radiance() evaluated in floats.
[[nodiscard]] glm::dvec3 radiance_error(const oracle::Model& model, const oracle::Scene& scene,
                                        const oracle::SurfacePoint& point, const oracle::Radiance& radiance,
                                        const PointErrors& errors);

/// How often a metallic-roughness surface is evaluated with roundings put in at random, and how many times
/// the largest change is the bound: a sample of so many seldom falls below a fifth of the worst case of a few
/// equal roundings, and each that the oracle puts in stands for about three of the shader's.
inline constexpr int kRoundedEvaluations = 12;
inline constexpr double kRoundedFactor = 16;

/// What incident light is known to: the length of its direction's error, each channel's error.
struct IncidentErrors {
    double direction = 0;
    double attenuation = 0;  ///< relative
    glm::dvec3 radiance{0};
};

/// Bounds for a light whose distance is computed from a position that is itself off by so much.
[[nodiscard]] IncidentErrors incident_errors(const oracle::Model& model,
                                             const oracle::IncidentLight& incident, double position_error);

/// Bound of the error of the direction to the viewer.
[[nodiscard]] double viewer_error(const oracle::Model& model, const glm::dvec3& position,
                                  double position_error);

/// Bound of the error of the half vector between two directions of those errors; `half_length` is their
/// sum's.
[[nodiscard]] double halfway_error(double to_light, double to_viewer, double half_length);

/// Bound of each channel's error of seen_through_fog(), given that of the radiance it blends.
[[nodiscard]] glm::dvec3 fog_error(const oracle::Model& model, const oracle::Scene& scene,
                                   const oracle::Seen& seen, const glm::dvec3& radiance,
                                   const glm::dvec3& radiance_error, double position_error);

}  // namespace gobo::verify
