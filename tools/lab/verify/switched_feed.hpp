// What the ubershader reads of a sample, where it does what the sample's model says.
#pragma once

#include <optional>
#include <string>

#include "lab/verify/feed.hpp"

namespace gobo::verify {

/// The field of that reflected name in the blocks that only the ubershader has, as uber_port() knows them.
/// Such fields are read, not set: no sample is made of what an ubershader was given.
[[nodiscard]] std::optional<Field> switched_field(const std::string& name);

}  // namespace gobo::verify
