// How much of a light gets past what its shadow map shows.
#pragma once

#include <vector>

#include "lab/oracle/decisions.hpp"
#include "lab/oracle/lights.hpp"
#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"

namespace gobo::oracle {

/// A light's share that reaches a point, with what its accuracy hangs on.
struct Visibility {
    double share = 1;         ///< 0 to 1
    double per_rounding = 0;  ///< bound of the share's change if each product and sum on the way changes by
                              ///< a relative amount, divided by that amount
    double per_length = 0;    ///< bound of its change if the point moves, divided by the distance
    double per_place = 0;  ///< bound of its change if texel centres, as a sampler is asked for them, change
                           ///< by a relative amount, divided by that amount
};

/// Looks the point up in one map (directional and spot lights) or in the six maps of a cube (point lights).
[[nodiscard]] Visibility visibility_in_map(const Model& model, const Scene& scene, const Shadow& shadow,
                                           const glm::dvec3& position, Decisions& decisions);
[[nodiscard]] Visibility visibility_in_cube(const Model& model, const Scene& scene, const Shadow& shadow,
                                            const glm::dvec3& position, Decisions& decisions);

/// Weakens each light that casts a shadow. `lights` are arrivals() at the position.
void cast_shadows(const Model& model, const Scene& scene, const glm::dvec3& position,
                  std::vector<Arrival>& lights, Decisions& decisions);

}  // namespace gobo::oracle
