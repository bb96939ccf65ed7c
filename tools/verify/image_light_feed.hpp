// Image-based light of samples: made, rounded, and handed to a stage.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "verify/feed.hpp"
#include "verify/random.hpp"

namespace gobo::verify {

/// Gives the sample environments to look up, bright in the mean and brighter to one side, turned any way.
void fill_image_lights(Random& random, oracle::Scene& scene);

/// Every number of them as a float.
void round_image_lights(oracle::Scene& scene);

/// The field of that reflected name: "ImageLight.share". Nothing where there is none.
[[nodiscard]] std::optional<Field> image_light_field(std::string_view name);

/// The map of the sampler `diffuseMap` or `specularMap`; nothing for another name.
[[nodiscard]] std::optional<evaluate::Image> image_light_map(std::string_view sampler,
                                                             std::span<const Sample> samples);

}  // namespace gobo::verify
