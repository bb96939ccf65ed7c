// The shadows of samples, for the block `Shadows`.
#pragma once

#include <optional>
#include <string_view>

#include "lab/verify/feed.hpp"

namespace gobo::verify {

/// The field of that reflected name: "Shadows.shadows[2].toMap". Nothing where there is none.
[[nodiscard]] std::optional<Field> shadow_field(std::string_view name);

}  // namespace gobo::verify
