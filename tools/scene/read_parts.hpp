// The parts that read_scene() is made of: each fills one part of a scene from the document.
#pragma once

#include "scene/accessor.hpp"

namespace gobo::scene {

/// Floats, or small whole numbers where glTF or KHR_mesh_quantization allows these, too.
inline const std::vector<Component> kFloatOrSmall = {Component::float32, Component::int8, Component::uint8,
                                                     Component::int16, Component::uint16};

/// What the members of an `extras.gobo` override. Members that are neither an override nor one of `others`
/// are errors.
[[nodiscard]] Overrides read_overrides(const Value& extras, std::vector<std::string> others = {});

/// With the pictures of materials that are cut by them; their files are added to those of the scene. The last
/// material is glTF's default one, for primitives that name none.
void read_materials(const Value& root, const Accessors& accessors, const FileSystem& disk, Scene& scene);
void read_meshes(const Value& root, Accessors& accessors, Scene& scene);
/// With their skins and their motion. Needs lights, cameras, meshes.
void read_nodes(const Value& root, Accessors& accessors, Scene& scene);

}  // namespace gobo::scene
