// Hybrid shading: what its vertex stage hands on and its fragment stage is given.
#pragma once

#include <vector>

#include "lab/oracle/lights.hpp"
#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/random.hpp"

namespace gobo::verify {

/// The rays to the local lights and the half vectors of all lights, as the vertex stage writes them at a
/// position that is itself off by so much.
[[nodiscard]] std::vector<Expected> expect_handed_on(const oracle::Model& model, const oracle::Scene& scene,
                                                     const glm::dvec3& position, double position_error,
                                                     oracle::Decisions& decisions);

/// Gives the surface point rays and half vectors such as interpolation makes of its lights': shorter than 1,
/// shares a little off, now and then below 0.
void hand_on(const oracle::Model& model, const oracle::Scene& scene, Random& random,
             oracle::SurfacePoint& point);

}  // namespace gobo::verify
