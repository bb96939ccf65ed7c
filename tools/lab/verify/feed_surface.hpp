// The fields of samples that the surface models read: materials, sides, colours, light from all around.
#pragma once

#include "lab/verify/feed.hpp"

namespace gobo::verify {

/// The field of that reflected name: "Materials.rows[2].diffuse". Nothing where samples have no such field.
[[nodiscard]] std::optional<Field> surface_field_of(const std::string& name);

}  // namespace gobo::verify
