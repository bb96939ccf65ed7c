// The parts that read_scene() is made of: each fills one part of a scene from the document. Whatever is wrong
// becomes an error of the document.
#pragma once

#include "scene/accessor.hpp"
#include "scene/document.hpp"
#include "scene/read_textures.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// The `extras.gobo` of an object; nothing where it has none.
[[nodiscard]] std::optional<Value> gobo_extras(Document& document, const Value& object);
/// The overrides among the members of an `extras.gobo`. Members that are neither an override nor one of
/// `others` are errors.
[[nodiscard]] Overrides read_overrides(Document& document, const Value& extras,
                                       std::vector<std::string> others);
/// A colour whose parts are not negative.
[[nodiscard]] std::optional<glm::dvec3> read_color(Document& document, const Value& parent,
                                                   std::string_view name);

void read_lights(Document& document, Scene& scene);
void read_cameras(Document& document, Scene& scene);
/// `textures` has the pictures of materials that are cut by them.
void read_materials(Document& document, Textures& textures, Scene& scene);
void read_meshes(Document& document, Accessors& accessors, Scene& scene);
void read_skins(Document& document, Accessors& accessors, Scene& scene);
/// Needs lights, cameras, meshes; skins are referred to by number and read afterwards.
void read_nodes(Document& document, Accessors& accessors, Scene& scene);
/// Needs nodes and meshes: gives animated nodes their motion.
void read_animations(Document& document, Accessors& accessors, Scene& scene);

/// Turns strips and fans into triangles, and computes flat normals where there are none: then no vertex is
/// shared. `mode` is glTF's: 4 triangles, 5 a strip, 6 a fan.
void finish_triangles(Primitive& primitive, int mode);

}  // namespace gobo::scene
