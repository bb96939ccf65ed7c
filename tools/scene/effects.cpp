#include "scene/effects.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/motion.hpp"
#include "scene/subject.hpp"

namespace gobo::scene {
namespace {

std::string draw_name(const Scene& scene, int node, int primitive) {
    const Node& here = scene.nodes[static_cast<std::size_t>(node)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(*here.mesh)];
    std::string name = here.name.empty() ? fmt::format("node {}", node) : here.name;
    if (mesh.primitives.size() > 1) name += fmt::format(", primitive {}", primitive);
    return name;
}

std::string why_excluded(const Primitive& primitive, const Material& material) {
    if (primitive.topology == Topology::points) return "its primitives are points";
    if (primitive.topology == Topology::lines) return "its primitives are lines";
    if (primitive.indices.empty()) return "it has no triangles";
    return is_cut_away(primitive, material) ? "all of it is more transparent than its material's alphaCutoff"
                                            : "";
}

/// The surface's normals in world space, where they never change and one side only is seen.
std::vector<glm::dvec3> fixed_normals(const Scene& scene, int node, const Primitive& primitive,
                                      const Material& material) {
    const Node& here = scene.nodes[static_cast<std::size_t>(node)];
    const glm::dmat3 linear(here.world);
    const auto is_shifted = [](const glm::dmat4& instance) { return glm::dmat3(instance) == glm::dmat3(1); };
    const bool are_turned = !std::all_of(here.instances.begin(), here.instances.end(), is_shifted);
    if (material.double_sided || here.skin || !primitive.target_positions.empty() || are_turned ||
        is_moving(scene, node) || glm::determinant(linear) == 0)
        return {};
    const glm::dmat3 to_world = glm::transpose(glm::inverse(linear));
    std::vector<glm::dvec3> normals;
    normals.reserve(primitive.normals.size());
    for (const glm::vec3& normal : primitive.normals) {
        const glm::dvec3 turned = to_world * glm::dvec3(normal);
        const double length = glm::length(turned);
        normals.push_back(length > 0 ? turned / length : glm::dvec3(0));
    }
    return normals;
}

bool scatters_or_reflects(const Material& material) {
    return material.diffuse != glm::dvec3(0) || material.specular != glm::dvec3(0);
}

/// What the surface gives back of a light that arrives with radiance 1, at most (the models of `lit`).
double response_of(const Material& material, const Overrides& overrides) {
    const bool has_highlight = overrides.specular != "none" && overrides.toon_levels.value_or(0) == 0;
    const glm::dvec3 most =
        material.diffuse + (has_highlight ? material.strength * material.specular : glm::dvec3(0));
    return std::max({most.r, most.g, most.b});
}

std::vector<Effect> judge_lights(const Subject& subject, const std::vector<PlacedLight>& lights,
                                 const Thresholds& thresholds) {
    std::vector<Effect> effects;
    const Receiver receiver{
        subject.draw.bounds,
        fixed_normals(subject.scene, subject.draw.node, subject.primitive, subject.material),
        response_of(subject.material, subject.overrides)};
    for (const PlacedLight& light : lights) {
        Verdict verdict{false, "its material gives back no light"};
        if (scatters_or_reflects(subject.material)) verdict = light_reach(light, receiver, thresholds.light);
        const std::string feature = light.label.substr(0, light.label.find(' '));
        effects.push_back({light.label, feature, "", verdict.is_in, std::move(verdict.reason)});
    }
    return effects;
}

Effect judge_toon(const Subject& subject) {
    Effect effect{"toon", "diffuse", "toon", false, ""};
    const int levels = subject.overrides.toon_levels.value_or(0);
    if (levels == 0) {
        effect.reason = "not asked for";
    } else if (!subject.is_lit) {
        effect.reason = "no light is in";
    } else {
        effect.is_in = true;
        effect.reason = fmt::format("{} levels", levels);
    }
    return effect;
}

Effect judge_specular(const Subject& subject, bool is_toon) {
    const std::string model = subject.overrides.specular.value_or("blinn");
    Effect effect{"specular", "specular", model, false, ""};
    const Material& material = subject.material;
    if (model == "none") {
        effect.reason = "not asked for";
    } else if (material.specular == glm::dvec3(0) || material.strength == 0) {
        effect.reason = "its material has no highlight";
    } else if (!subject.is_lit) {
        effect.reason = "no light is in";
    } else if (is_toon) {
        effect.reason = "toon shading has no highlights";
    } else {
        effect.is_in = true;
        effect.reason = fmt::format("{}, shininess {:.3g}", model, material.shininess);
    }
    return effect;
}

/// The share of the surface that fog hides at a distance (the pieces of shader_lib/fog).
double hidden_share(const Fog& fog, double distance) {
    const double thickness = fog.density * distance;
    return 1 - std::exp(fog.kind == "exponential" ? -thickness : -thickness * thickness);
}

Effect judge_fog(const Subject& subject, const EyePlace& eye, double threshold) {
    const Fog fog = subject.overrides.fog.value_or(Fog{"none", {}, 0, 0, 0});
    Effect effect{"fog", "fog", fog.kind, true, ""};
    if (fog.kind == "none") {
        effect.is_in = false;
        effect.reason = "none is stated";
    } else if (!subject.draw.bounds) {
        effect.reason = "bounds are not known";
    } else if (!eye) {
        effect.reason = "no camera tells the distance";
    } else {
        const double farthest = greatest_distance(*eye, *subject.draw.bounds);
        const double share = fog.kind == "linear" ? 0 : hidden_share(fog, farthest);
        if (fog.kind == "linear") {
            effect.is_in = farthest > fog.near;
            effect.reason = fmt::format("bounds end at {:.3g}, it begins at {:.3g}", farthest, fog.near);
        } else {
            effect.is_in = share >= threshold;
            effect.reason = fmt::format("at {:.3g} it hides {:.2g}{}", farthest, share,
                                        effect.is_in ? "" : fmt::format(", below {:.2g}", threshold));
        }
    }
    return effect;
}

std::vector<Draw> draws_of(const Scene& scene) {
    std::vector<Draw> draws;
    for (const int index : scene.order) {
        const Node& node = scene.nodes[static_cast<std::size_t>(index)];
        if (!node.mesh) continue;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(*node.mesh)];
        for (int i = 0; i < static_cast<int>(mesh.primitives.size()); ++i) {
            const Primitive& primitive = mesh.primitives[static_cast<std::size_t>(i)];
            const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
            Draw draw{index, i, draw_name(scene, index, i), why_excluded(primitive, material), {}, {}};
            if (draw.excluded.empty()) draw.bounds = world_bounds(scene, index, primitive);
            draws.push_back(std::move(draw));
        }
    }
    return draws;
}

Subject subject_of(const Scene& scene, const Draw& draw) {
    return {scene, draw, primitive_of(scene, draw), material_of(scene, draw), overrides_of(scene, draw),
            false};
}

EyePlace eye_where(const Scene& scene, const std::optional<int>& camera) {
    Box places;
    for (const int index : scene.order) {
        const auto& here = scene.nodes[static_cast<std::size_t>(index)].camera;
        if (here && (!camera || here == camera))
            places.add(world_box(scene, index, {glm::dvec3(0), glm::dvec3(0)}));
    }
    return places.is_empty() ? EyePlace() : places;
}

}  // namespace

const Primitive& primitive_of(const Scene& scene, const Draw& draw) {
    const Node& node = scene.nodes[static_cast<std::size_t>(draw.node)];
    return scene.meshes[static_cast<std::size_t>(*node.mesh)]
        .primitives[static_cast<std::size_t>(draw.primitive)];
}

const Material& material_of(const Scene& scene, const Draw& draw) {
    return scene.materials[static_cast<std::size_t>(primitive_of(scene, draw).material)];
}

Overrides overrides_of(const Scene& scene, const Draw& draw) {
    Overrides overrides = material_of(scene, draw).overrides;
    overrides.fill_from(scene.nodes[static_cast<std::size_t>(draw.node)].overrides);
    return overrides;
}

EyePlace eye_of_cameras(const Scene& scene) {
    return eye_where(scene, std::nullopt);
}

EyePlace eye_of_camera(const Scene& scene, int camera) {
    return eye_where(scene, camera);
}

std::vector<Draw> required_effects(const Scene& scene, const EyePlace& eye, const Thresholds& thresholds) {
    std::vector<Draw> draws = draws_of(scene);
    const std::vector<PlacedLight> lights = place_lights(scene);
    for (Draw& draw : draws) {
        if (!draw.excluded.empty()) continue;
        Subject subject = subject_of(scene, draw);
        draw.effects = judge_lights(subject, lights, thresholds);
        subject.is_lit = std::any_of(draw.effects.begin(), draw.effects.end(),
                                     [](const Effect& light) { return light.is_in; });
        const Effect toon = judge_toon(subject);
        const std::vector<Effect> shadows = judge_shadows(subject, lights, draws);
        const std::vector<Effect> surface = judge_surface(subject);
        draw.effects.push_back(toon);
        draw.effects.push_back(judge_specular(subject, toon.is_in));
        draw.effects.push_back(judge_fog(subject, eye, thresholds.fog));
        draw.effects.insert(draw.effects.end(), surface.begin(), surface.end());
        draw.effects.insert(draw.effects.end(), shadows.begin(), shadows.end());
    }
    return draws;
}

}  // namespace gobo::scene
