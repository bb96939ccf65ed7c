// The two shapes of a glTF file: JSON text, or a binary container of JSON and one buffer.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"

namespace gobo::scene {

/// The parts of a glTF file; they refer to its content.
struct Container {
    std::string_view json;
    std::optional<std::string_view> binary;  ///< the buffer that a .glb holds
};

/// Takes a file apart. What begins with "glTF" is a container of version 2 (glTF 2.0 specification, ch. 4),
/// anything else is JSON. Fault::input where a container is cut short or its chunks are not as they must be.
[[nodiscard]] Result<Container> open_container(std::string_view content, const std::string& path);

}  // namespace gobo::scene
