// Scenes that no study of lit saw: other meshes, cameras, lights and materials.
#pragma once

#include <vector>

#include "lab/study/plan.hpp"

namespace gobo::study {

/// Lights of about the study's radiance: errors are in linear radiance, and grow with it.
[[nodiscard]] std::vector<DrawnScene> held_out_scenes(const Family& family);

}  // namespace gobo::study
