// From a glTF 2.0 file to a Scene.
#pragma once

#include <string>

#include "core/file_system.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// Reads a .gltf or .glb file with its buffers; docs/scene_format.md says what is read and how. Anything that
/// the specification forbids and that would matter is one error with the path of the value in the file: an
/// index or an accessor out of range, a wrong type, a cycle of nodes, a number that is not finite, a
/// container cut short. An extension that the file requires and that is not read is an error that names it.
/// Fault::file where the scene or a buffer cannot be read. Pictures are read where they
/// cut their material or, for Reading::physical, where it shows them.
enum class Reading {
    classic,   ///< for `lit`
    physical,  ///< for families with metallic-roughness materials and their pictures, as `pbr`
};
[[nodiscard]] Result<Scene> read_scene(const FileSystem& files, const std::string& path,
                                       Reading reading = Reading::classic);

}  // namespace gobo::scene
