// What arrives of each light at a surface point.
#pragma once

#include <vector>

#include "lab/oracle/decisions.hpp"
#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"

namespace gobo::oracle {

/// The angle between two directions of any length, 0 to pi; a right angle where either is zero.
[[nodiscard]] double angle_between(const glm::dvec3& a, const glm::dvec3& b);

/// The vector's direction; zero where it is zero.
[[nodiscard]] glm::dvec3 direction_of(const glm::dvec3& vector);

/// 1 / (k_c + k_l d + k_q d^2), the denominator at least 1e-18, as the domain says.
[[nodiscard]] double attenuation(const glm::dvec3& coefficients, double distance);

/// The share of a spot light on a ray at `angle` from its axis: e cos(angle)^exponent, with e falling from 1
/// at the inner angle to 0 at the outer one as the square of what is left of the way in versines. A hard edge
/// is decided by the angle, which `resolution` is a multiple of kEdgeWidth too coarse for: 1 where angles are
/// told apart as well as versines allow.
[[nodiscard]] double cone_share(const SpotLight& light, double angle, Decisions& decisions,
                                double resolution = 1);

/// How much coarser than kEdgeWidth an angle is told by the key's formula: the plain cosine is off by 2^-21
/// where it has gone through a direction's roundings, and changes by no more than the sine of the angle.
[[nodiscard]] double angle_resolution(SpotEdge edge, double angle);

/// One light at one point.
struct Arrival {
    glm::dvec3 to_light{0};  ///< unit; zero where the light gives nothing
    glm::dvec3 radiance{0};  ///< after attenuation and cone
    glm::dvec3 unshaped{0};  ///< after attenuation alone: an upper bound, by which errors are measured
    double distance = 0;     ///< 0 for a directional light
    double fading = 1;       ///< the attenuation alone
    bool is_given = false;   ///< `to_light` is an input, made unit by the application
    double place_size = 0;   ///< |P| of a position that is divided by its w, and so rounded
    double cone_angle = 0;   ///< between the ray and a spot light's axis
    const SpotLight* spot = nullptr;  ///< of the scene that was asked, which must outlive this
    bool is_interpolated = false;     ///< direction and share are what hybrid shading hands on, not computed
    bool is_shadowed = false;         ///< a shadow map was asked
    double shadow_per_rounding = 0;   ///< as of Visibility
    double shadow_per_length = 0;
    double shadow_per_place = 0;
};

/// What a lighting model does with a direction that it is given: it makes it unit, or takes it as it is.
[[nodiscard]] glm::dvec3 shading_direction(const Model& model, const glm::dvec3& given);

/// All lights at a point: directional, point, spot, homogeneous, each in the scene's order.
[[nodiscard]] std::vector<Arrival> arrivals(const Model& model, const Scene& scene,
                                            const glm::dvec3& position, Decisions& decisions);

/// The same as hybrid shading has them at a fragment: local lights by the point's interpolated rays.
[[nodiscard]] std::vector<Arrival> interpolated_arrivals(const Model& model, const Scene& scene,
                                                         const SurfacePoint& point);

}  // namespace gobo::oracle
