// What arrives of each light at a surface point, past what stands between, and where a radiance jumps.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"

namespace gobo::oracle {

// The questions with two answers that a lighting model asks.

/// Within this distance of an edge, either answer is right: a float's rounding may decide it. It is ten times
/// what sixteen roundings of a unit quantity amount to (16 * 2^-24 = 1e-6).
inline constexpr double kEdgeWidth = 1e-5;

/// Answers questions, keeps how near to the edge the nearest one was, and can be told to give the other
/// answer where both are right. All quantities are of size 1: cosines, 1 - cos, ratios of distances.
class Decisions {
  public:
    /// Bit i of `flipped`: the i-th question that lies within kEdgeWidth of its edge gets the other answer.
    explicit Decisions(std::uint32_t flipped = 0) : flipped_(flipped) {}

    /// Whether quantity > edge.
    [[nodiscard]] bool above(double quantity, double edge);

    /// The distance of the nearest deciding quantity from its edge; 2 or more where nothing was asked.
    [[nodiscard]] double nearest() const { return nearest_; }
    /// How many questions lay within kEdgeWidth of their edge.
    [[nodiscard]] int open() const { return open_; }

  private:
    std::uint32_t flipped_;
    double nearest_ = 2;
    int open_ = 0;
};

/// The angle between two directions of any length, 0 to pi; a right angle where either is zero.
[[nodiscard]] double angle_between(const glm::dvec3& a, const glm::dvec3& b);

/// 1 - cos of an angle, without the cancellation at small ones.
[[nodiscard]] double one_minus_cosine_of(double angle);

/// The vector's direction; zero where it is zero.
[[nodiscard]] glm::dvec3 direction_of(const glm::dvec3& vector);

/// 1 / (k_c + k_l d + k_q d^2), the denominator at least 1e-18, as the domain says.
[[nodiscard]] double attenuation(const glm::dvec3& coefficients, double distance);

/// The weight of a spot light on a ray at `angle` from its axis: e cos(angle)^exponent, with e falling from 1
/// at the inner angle to 0 at the outer one as the square of what is left of the way in 1 - cos. A hard edge
/// is decided by the angle, which `resolution` is a multiple of kEdgeWidth too coarse for: 1 where angles are
/// told apart as well as 1 - cos allows.
[[nodiscard]] double cone_weight(const SpotLight& light, double angle, Decisions& decisions,
                                 double resolution = 1);

/// How much coarser than kEdgeWidth an angle is told by the key's formula: the plain cosine is off by 2^-21
/// where it has gone through a direction's roundings, and changes by no more than the sine of the angle.
[[nodiscard]] double angle_resolution(SpotEdge edge, double angle);

/// How much of a light reaches a point, with what its accuracy hangs on.
struct Visibility {
    double weight = 1;        ///< 0 to 1
    double per_rounding = 0;  ///< bound of the weight's change if each product and sum on the way changes by
                              ///< a relative amount, divided by that amount
    double per_length = 0;    ///< bound of its change if the point moves, divided by the distance
    double per_place = 0;  ///< bound of its change if texel centres, as a sampler is asked for them, change
                           ///< by a relative amount, divided by that amount
};

/// One light at one point.
struct IncidentLight {
    glm::dvec3 to_light{0};  ///< unit; zero where the light gives nothing
    glm::dvec3 radiance{0};  ///< after attenuation and cone
    glm::dvec3 unshaped{0};  ///< after attenuation alone: an upper bound, by which errors are measured
    double distance = 0;     ///< 0 for a directional light
    double attenuation = 1;  ///< the attenuation alone
    double window = 1;       ///< what the range leaves, 0 to 1
    bool is_given = false;   ///< `to_light` is an input, made unit by the application
    double place_size = 0;   ///< |P| of a position that is divided by its w, and so rounded
    double cone_angle = 0;   ///< between the ray and a spot light's axis
    const SpotLight* spot = nullptr;  ///< of the scene that was asked, which must outlive this
    bool is_interpolated = false;     ///< direction and weight are interpolated, as hybrid shading has them
    bool is_shadowed = false;         ///< a shadow map was asked
    Visibility shadow;
};

/// What a lighting model does with a direction that it is given: it makes it unit, or takes it as it is.
[[nodiscard]] glm::dvec3 shading_direction(const Model& model, const glm::dvec3& given);

/// All lights at a point: directional, point, spot and those of either kind, each in the scene's order.
[[nodiscard]] std::vector<IncidentLight> incident_lights(const Model& model, const Scene& scene,
                                                         const glm::dvec3& position, Decisions& decisions);

/// The same as hybrid shading has them at a fragment: local lights by the point's interpolated rays.
[[nodiscard]] std::vector<IncidentLight> interpolated_incident_lights(const Model& model, const Scene& scene,
                                                                      const SurfacePoint& point);

/// Weakens each light that casts a shadow. `lights` are incident_lights() at the position.
void cast_shadows(const Model& model, const Scene& scene, const glm::dvec3& position,
                  std::vector<IncidentLight>& lights, Decisions& decisions);

}  // namespace gobo::oracle
