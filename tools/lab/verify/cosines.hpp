// Cosines of lights that are found at the vertices: what the vertex stage hands on, and the fragment stage is
// given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/oracle/lights.hpp"
#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/feed.hpp"
#include "lab/verify/random.hpp"

namespace gobo::verify {

/// The cosines of all lights as the vertex stage writes them, four to a vector and 0 behind the last, at a
/// position and a unit normal that are off by so much.
[[nodiscard]] std::vector<Expected> expect_cosines(const oracle::Model& model, const oracle::Scene& scene,
                                                   const oracle::SurfacePoint& vertex, double position_error,
                                                   double normal_error, oracle::Decisions& decisions);

/// The field of that reflected name: "lightCosines[1]" holds the lights 4 to 7. Nothing where there is none.
[[nodiscard]] std::optional<Field> cosines_field(const std::string& name);

/// Gives the surface point cosines such as interpolation makes of its lights': nearer to 0.
void hand_on_cosines(const oracle::Model& model, const oracle::Scene& scene, Random& random,
                     oracle::SurfacePoint& point);

}  // namespace gobo::verify
