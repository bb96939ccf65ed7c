// How much of a surface is seen through fog.
#pragma once

#include "lab/oracle/decisions.hpp"
#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"

namespace gobo::oracle {

/// How much fog lies before a point: |p| or |p.z|.
[[nodiscard]] double fog_distance(FogDistance kind, const glm::dvec3& position);

/// The share of the surface's radiance that gets through, 0 to 1. Where near = far linear fog is a step:
/// clear before that distance, hidden from it on.
[[nodiscard]] double clearness(Fog kind, const FogParameters& fog, double distance, Decisions& decisions);

}  // namespace gobo::oracle
