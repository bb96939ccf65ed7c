// Shadows for the samples of `lit`: maps that put each point into the light, into the shadow, or on the
// border.
#pragma once

#include "lab/oracle/model.hpp"
#include "lab/verify/random.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// Gives the sample the shadows that the model counts, and maps for them: of 1 to 8 texels a side, the point
/// on the map or a little beside it, before or behind the light, and texels around that are nearer to the
/// light than the point by up to 0.3, or further.
void add_shadows(const oracle::Model& model, Random& random, Sample& sample);

}  // namespace gobo::verify
