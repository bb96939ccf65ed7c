// Small scenes for the tests: one that works, and changes to it.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/file_system.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// A quad of side 2 about the origin, facing +z, as "quad.bin" holds it: positions, indices, two moments, two
/// translations.
[[nodiscard]] std::string quad_buffer();

/// A scene with the quad, in which everything is in order:
/// nodes "quad" (mesh 0), "lamp" (point light at 0, 0, 2), "camera" (at 0, 0, 5).
[[nodiscard]] nlohmann::json quad_scene();

/// The RFC 6902 patches that add the value at a place and take away what is there, and one that gives the
/// quad instances.
[[nodiscard]] std::string put(std::string_view path, std::string_view value);
[[nodiscard]] std::string take(std::string_view path);
[[nodiscard]] std::string instanced(std::string_view attributes);

/// `quad_scene()` after an RFC 6902 patch.
[[nodiscard]] nlohmann::json patched_scene(std::string_view patch);

/// Reads "quad.gltf" beside "quad.bin".
[[nodiscard]] Result<Scene> read_json(const nlohmann::json& json);

/// Reads a patched scene that must be in order; a failed expectation and an empty scene otherwise.
[[nodiscard]] Scene read_patched(std::string_view patch);

/// The container of version 2 that holds a text and a buffer.
[[nodiscard]] std::string container_of(std::string json, std::string binary);

[[nodiscard]] std::string float_bytes(std::initializer_list<float> numbers);

/// Bytes as data URIs hold them.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace gobo::scene
