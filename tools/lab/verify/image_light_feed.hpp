// Image-based light of samples: made, rounded, and its fields.
#pragma once

#include <optional>
#include <string_view>

#include "lab/verify/feed.hpp"
#include "lab/verify/random.hpp"

namespace gobo::verify {

/// Gives the sample environments to look up, bright in the mean and brighter to one side, turned any way.
void fill_image_lights(Random& random, oracle::Scene& scene);

/// Every number of them as a float.
void round_image_lights(oracle::Scene& scene);

/// The field of that reflected name: "ImageLight.weight". Nothing where there is none.
[[nodiscard]] std::optional<Field> image_light_field(std::string_view name);

}  // namespace gobo::verify
