// Hands the shadows of samples to a stage: the block `Shadows` and the sampler `shadowMaps`.
#pragma once

#include <optional>
#include <string_view>

#include "verify/feed.hpp"

namespace gobo::verify {

/// The field of that reflected name: "Shadows.shadows[2].toMap". Nothing where there is none.
[[nodiscard]] std::optional<Field> shadow_field(std::string_view name);

/// The maps of the samples as the image of a sampler: each invocation sees those of its own sample.
[[nodiscard]] evaluate::Image shadow_maps_of(std::span<const Sample> samples);

}  // namespace gobo::verify
