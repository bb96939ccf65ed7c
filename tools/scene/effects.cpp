#include "scene/effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "scene/geometry.hpp"
#include "scene/material_extensions.hpp"

namespace gobo::scene {
namespace {

/// A draw being judged.
struct Subject {
    const Scene& scene;
    const Draw& draw;
    const Primitive& primitive;
    const Material& material;
    Overrides overrides;
    std::vector<glm::dvec3>
        normals;          ///< in world space; empty where they are not known or both sides are lit
    bool is_lit = false;  ///< some light is in
};

struct Verdict {
    bool is_in = false;
    std::string reason;
};

/// What single precision may add to a distance: shaders compute in it. A light is dropped only if it misses
/// by more.
constexpr double kRelativeMargin = 1e-5;

bool has_end(const Light& light) {
    return light.kind != LightKind::directional && std::isfinite(light.range);
}

double brightest(const Light& light) {
    return std::max({light.color.r, light.color.g, light.color.b});
}

/// The radiance that arrives from a local light at a distance, at most.
double incident(const Light& light, double distance) {
    const glm::dvec3& k = light.attenuation;
    return brightest(light) / std::max(k.x + distance * (k.y + distance * k.z), 1e-18);
}

/// The distance at which the light has fallen to the threshold; infinite where it never does.
double attenuated_reach(const Light& light, double threshold) {
    const glm::dvec3& k = light.attenuation;
    const double excess = k.x - brightest(light) / threshold;  // k_q d^2 + k_l d + excess = 0
    if (excess >= 0) return 0;
    if (k.z == 0) return k.y == 0 ? std::numeric_limits<double>::infinity() : -excess / k.y;
    return (-k.y + std::sqrt(k.y * k.y - 4 * k.z * excess)) / (2 * k.z);
}

/// Whether dot(normal, toward the light) can be positive nowhere on the surface, for any mean of the normals
/// at any point of the bounds: the expression is linear in each, so its corners decide.
bool faces_away(const PlacedLight& light, const Subject& subject) {
    if (subject.normals.empty() || light.turns) return false;
    const bool is_directional = light.light->kind == LightKind::directional;
    if (!is_directional && !subject.draw.bounds) return false;
    return std::all_of(subject.normals.begin(), subject.normals.end(), [&](const glm::dvec3& normal) {
        if (is_directional) return glm::dot(normal, -light.direction) <= -kRelativeMargin;
        const Box to_light = sum(light.positions, {-subject.draw.bounds->high, -subject.draw.bounds->low});
        const Box terms = product({normal, normal}, to_light);
        const double margin =
            kRelativeMargin * glm::length(glm::max(glm::abs(to_light.low), glm::abs(to_light.high)));
        return terms.high.x + terms.high.y + terms.high.z <= -margin;
    });
}

/// How far the cone of a spot light is from the bounds, certainly.
double cone_gap(const PlacedLight& light, const Box& bounds, double threshold) {
    if (light.turns || light.positions.low != light.positions.high || light.direction == glm::dvec3(0))
        return 0;
    const double radius = std::min(light.light->range, attenuated_reach(*light.light, threshold));
    const LitVolume volume{light.positions.low, light.direction, light.light->outer_angle, radius};
    const double gap = proven_gap(volume, bounds);
    return gap <= kRelativeMargin * greatest_distance(light.positions, bounds) ? 0 : gap;
}

Verdict judge_local_light(const PlacedLight& placed, const Subject& subject, double threshold) {
    if (!subject.draw.bounds) return {true, "bounds are not known"};
    const Light& light = *placed.light;
    const double distance = least_distance(placed.positions, *subject.draw.bounds);
    const double beyond = distance - light.range;
    const double arriving = incident(light, distance);
    if (beyond > kRelativeMargin * distance)
        return {false, fmt::format("bounds begin {:.3g} beyond its range of {:.3g}", beyond, light.range)};
    if (arriving < threshold)
        return {false, fmt::format("at {:.3g} it has fallen to {:.2g}, below {:.2g}", distance, arriving,
                                   threshold)};
    if (light.kind == LightKind::spot) {
        if (light.outer_angle == 0) return {false, "its cone is empty"};
        if (const double gap = cone_gap(placed, *subject.draw.bounds, threshold); gap > 0)
            return {false, fmt::format("cone misses bounds by {:.2g}", gap)};
    }
    if (faces_away(placed, subject)) return {false, "every normal faces away from it"};
    if (distance == 0) return {true, "it may be as near as can be"};
    return {true, fmt::format("at {:.3g} up to {:.2g} arrives", distance, arriving)};
}

/// A light is out where it is black, where the bounds begin beyond its range, where its greatest radiance has
/// fallen so far there that the surface gives back less than `threshold`, where its cone misses them, or
/// where every normal faces away from it. It is in wherever none of this is certain.
Verdict judge_light(const PlacedLight& light, const Subject& subject, double threshold) {
    const double most = brightest(*light.light);
    if (most == 0) return {false, "its intensity is 0"};
    if (light.light->kind != LightKind::directional) return judge_local_light(light, subject, threshold);
    if (most < threshold)
        return {false, fmt::format("its radiance is {:.2g}, below {:.2g}", most, threshold)};
    if (faces_away(light, subject)) return {false, "every normal faces away from it"};
    return {true, "it reaches everything"};
}

/// A reason to leave an effect out, where it holds.
struct Objection {
    bool holds;
    std::string reason;
};

/// The effect is in unless an objection holds; the first that does is its reason.
Effect decide(std::string name, std::string feature, std::string value,
              const std::vector<Objection>& objections, std::string why_in) {
    const auto against = std::ranges::find_if(objections, &Objection::holds);
    const bool is_in = against == objections.end();
    return {std::move(name), std::move(feature), std::move(value), is_in,
            is_in ? std::move(why_in) : against->reason};
}

/// The surface's normals in world space, where they never change and one side only is seen.
std::vector<glm::dvec3> fixed_normals(const Subject& subject) {
    const Node& node = subject.scene.nodes[subject.draw.node];
    const Primitive& primitive = subject.primitive;
    const glm::dmat3 linear(node.world);
    const auto is_shifted = [](const glm::dmat4& instance) { return glm::dmat3(instance) == glm::dmat3(1); };
    if (subject.material.double_sided || node.skin || !primitive.target_positions.empty() ||
        !std::ranges::all_of(node.instances, is_shifted) || is_moving(subject.scene, subject.draw.node) ||
        glm::determinant(linear) == 0)
        return {};
    const glm::dmat3 to_world = glm::transpose(glm::inverse(linear));
    std::vector<glm::dvec3> normals;
    normals.reserve(primitive.normals.size());
    for (const glm::vec3& normal : primitive.normals)
        normals.push_back(unit_or_zero(to_world * glm::dvec3(normal)));
    return normals;
}

bool is_black(const glm::dvec3& color) {
    return color == glm::dvec3(0);
}

/// What the surface gives back of a light that arrives with radiance 1, at most (the models of `lit`).
double response_of(const Scene& scene, const Material& material, const Overrides& overrides) {
    if (scene.is_physical) {
        // D is at most 1 / (pi alpha^2), V n.l at most 1 / (2 alpha), Fresnel's reflectance 1: of a picture
        // the least roughness is not known.
        const auto& map = material.physical.maps[static_cast<std::size_t>(MapKind::metallic_roughness)];
        const double roughness = map ? 0 : material.physical.roughness;
        const double alpha = std::max(roughness * roughness, 0.002);
        return (1 + 0.5 / (alpha * alpha * alpha)) / std::numbers::pi;
    }
    const bool has_highlight = overrides.specular != "none" && overrides.toon_levels.value_or(0) == 0;
    const glm::dvec3 most =
        material.diffuse + (has_highlight ? material.strength * material.specular : glm::dvec3(0));
    return std::max({most.r, most.g, most.b});
}

void judge_lights(const Subject& subject, const std::vector<PlacedLight>& lights, double threshold,
                  std::vector<Effect>& effects) {
    const bool gives_back = subject.scene.is_physical
                                ? !subject.material.unlit
                                : !is_black(subject.material.diffuse) || !is_black(subject.material.specular);
    const double least = threshold / response_of(subject.scene, subject.material, subject.overrides);
    for (const PlacedLight& light : lights) {
        Verdict verdict{false, "its material gives back no light"};
        if (gives_back) verdict = judge_light(light, subject, least);
        effects.push_back({light.label, light.feature, "", verdict.is_in, std::move(verdict.reason)});
    }
}

Effect judge_fog(const Subject& subject, const EyePlace& eye, double threshold) {
    const Fog fog = subject.overrides.fog.value_or(Fog{"none", {}, 0, 0, 0});
    const auto effect = [&](bool is_in, std::string reason) {
        return Effect{"fog", "fog", fog.kind, is_in, std::move(reason)};
    };
    if (fog.kind == "none") return effect(false, "none is stated");
    if (!subject.draw.bounds) return effect(true, "bounds are not known");
    if (!eye) return effect(true, "no camera tells the distance");
    const double farthest = greatest_distance(*eye, *subject.draw.bounds);
    if (fog.kind == "linear")
        return effect(farthest > fog.near,
                      fmt::format("bounds end at {:.3g}, it begins at {:.3g}", farthest, fog.near));
    // How much of the surface it hides there (the pieces of shader_lib/fog).
    const double thickness = fog.density * farthest;
    const double hidden = 1 - std::exp(fog.kind == "exponential" ? -thickness : -thickness * thickness);
    const bool is_in = hidden >= threshold;
    return effect(is_in, fmt::format("at {:.3g} it hides {:.2g}{}", farthest, hidden,
                                     is_in ? "" : fmt::format(", below {:.2g}", threshold)));
}

/// The least and the greatest of every `step`-th number from `first` on, in 255ths.
Interval range_of(const std::vector<std::uint8_t>& numbers, std::size_t first, std::size_t step) {
    Interval range{1, 0};
    for (std::size_t i = first; i < numbers.size(); i += step) range.add(numbers[i] / 255.0);
    return numbers.empty() ? Interval{0, 1} : range;
}

/// The least and the greatest alpha that the surface may have somewhere, by what its picture has.
Interval alpha_range(const Primitive& primitive, double alpha, const Interval& of_map) {
    Interval of_vertices{1, 1};
    if (!primitive.colors.empty()) {
        of_vertices = {1, 0};
        for (const glm::vec4& color : primitive.colors) of_vertices.add(color.a);
    }
    return {alpha * of_map.low * of_vertices.low, alpha * of_map.high * of_vertices.high};
}

Interval alpha_range(const Scene& scene, const Primitive& primitive, const Material& material) {
    if (scene.is_physical) {
        const auto& use = material.physical.maps[static_cast<std::size_t>(MapKind::base_color)];
        return alpha_range(primitive, material.physical.base_color.a,
                           use ? range_of(scene.pictures[use->picture].texels, 3, 4) : Interval{1, 1});
    }
    return alpha_range(primitive, material.alpha,
                       material.opacity ? range_of(material.opacity->texels, 0, 1) : Interval{1, 1});
}

Effect judge_vertex_color(const Primitive& primitive, const Material& material, const glm::dvec3& scattered) {
    bool is_colored = false;
    bool is_transparent = false;
    for (const glm::vec4& color : primitive.colors) {
        is_colored = is_colored || glm::vec3(color) != glm::vec3(1);
        is_transparent = is_transparent || (color.a != 1 && material.alpha_mode != AlphaMode::opaque);
    }
    const bool is_seen = is_colored && !is_black(scattered);
    return decide("vertex_color", "vertex_color", "modulate",
                  {{primitive.colors.empty(), "it has none"},
                   {!is_seen && !is_transparent,
                    is_colored ? "its material has no diffuse or ambient colour" : "all are white"}},
                  is_seen ? "its vertices have colours" : "its vertices are not opaque");
}

Effect judge_sides(const Material& material) {
    return decide("sides", "sides", "two", {{!material.double_sided, "not marked"}},
                  "its material is marked doubleSided");
}

Effect judge_cutout(const Subject& subject) {
    const Material& material = subject.material;
    const double lowest = alpha_range(subject.scene, subject.primitive, material).low;
    return decide("cutout", "cutout", "threshold",
                  {{material.alpha_mode != AlphaMode::mask, "alphaMode is not MASK"},
                   {lowest >= material.alpha_cutoff,
                    fmt::format("its alpha is nowhere below {:.3g}", material.alpha_cutoff)}},
                  fmt::format("its alpha falls to {:.3g}, below {:.3g}", lowest, material.alpha_cutoff));
}

/// What the material and the overrides decide, once the lights are judged.
void judge_surface(const Subject& subject, const EyePlace& eye, double fog_threshold,
                   std::vector<Effect>& effects) {
    const Overrides& overrides = subject.overrides;
    const Material& material = subject.material;
    const int levels = overrides.toon_levels.value_or(0);
    const std::string specular = overrides.specular.value_or("blinn");
    const std::string probe = overrides.probe ? overrides.probe->kind : "none";
    const double reflection = overrides.reflection.value_or(0);
    const Objection unlit{!subject.is_lit, "no light is in"};
    const Objection dull{is_black(material.specular) || material.strength == 0,
                         "its material has no highlight"};
    effects.insert(effects.end(),
                   {decide("toon", "diffuse", "toon", {{levels == 0, "not asked for"}, unlit},
                           fmt::format("{} levels", levels)),
                    decide("specular", "specular", specular,
                           {{specular == "none", "not asked for"},
                            dull,
                            unlit,
                            {levels != 0, "toon shading has no highlights"}},
                           fmt::format("{}, shininess {:.3g}", specular, material.shininess)),
                    judge_fog(subject, eye, fog_threshold), judge_sides(material), judge_cutout(subject),
                    judge_vertex_color(subject.primitive, material, material.diffuse + material.ambient),
                    decide("texture", "texture", "on", {{!material.is_textured, "it has none"}},
                           "its material has textures"),
                    decide("probe", "ambient", probe,
                           {{probe == "none", "not asked for"},
                            {is_black(material.ambient), "its material gives back no ambient light"}},
                           probe),
                    decide("reflection", "reflection", "image", {{reflection == 0, "not asked for"}, dull},
                           fmt::format("a share of {:.3g}", reflection))});
    for (const auto& [feature, value] : overrides.quality)
        effects.push_back({feature, feature, value, true, "asked for"});
}

/// Whether a picture's texels are alike, to within a step, in the channels of the mask: then what it would
/// say is `expected`, in 255ths.
bool says_only(const TextureImage& picture, const std::array<int, 4>& expected, unsigned channels,
               int slack) {
    for (std::size_t i = 0; i < picture.texels.size(); ++i)
        if ((channels >> (i % 4) & 1U) != 0 && std::abs(picture.texels[i] - expected[i % 4]) > slack)
            return false;
    return true;
}

std::string why_not_placed(std::int64_t set) {
    return fmt::format("its mesh has no texture coordinates of set {}", set);
}

/// A picture of a metallic-roughness material: out where it changes nothing.
Effect judge_map(const Subject& subject, MapKind kind) {
    const PhysicalMaterial& material = subject.material.physical;
    const auto number = static_cast<std::size_t>(kind);
    const std::optional<TextureUse>& use = material.maps[number];
    const std::string feature = kMapFeatures[number];
    const bool is_normal = kind == MapKind::normal;
    const std::string value = is_normal ? "tangent" : "texture";
    std::vector<Objection> objections = {{!use, "it has none"}};
    if (use) {
        const Primitive& primitive = subject.primitive;
        const auto& places = use->set == 0 ? primitive.texcoords : primitive.texcoords1;
        const TextureImage& picture = subject.scene.pictures[use->picture];
        const bool shows_alpha = subject.material.alpha_mode != AlphaMode::opaque;
        const std::array<unsigned, 5> channels = {shows_alpha ? 15U : 7U, 6U, 7U, 1U, 7U};
        const std::array<int, 4> expected =
            is_normal ? std::array{128, 128, 255, 255} : std::array{255, 255, 255, 255};
        const bool is_lit =
            subject.is_lit || subject.overrides.reflection.value_or(0) > 0 || subject.overrides.probe;
        objections.insert(
            objections.end(),
            {{use->set > 1,
              fmt::format("its texture coordinates are set {}, of which 0 and 1 are read", use->set)},
             {is_normal && primitive.tangents.empty() && !places.empty(), "its mesh has no tangents"},
             {is_normal && material.normal_scale == 0, "its scale is 0"},
             {is_normal && !is_lit, "no light is in"},
             {kind == MapKind::occlusion && material.occlusion_strength == 0, "its strength is 0"},
             {kind == MapKind::emissive && is_black(subject.material.emission), "its material emits nothing"},
             {kind != MapKind::base_color && subject.material.unlit, "its material is unlit"},
             {says_only(picture, expected, channels[number], is_normal ? 1 : 0),
              is_normal ? "it is flat" : "it is white"},
             {places.empty(), why_not_placed(use->set)}});
    }
    return decide(feature, feature, value, objections,
                  use ? fmt::format("{} x {} texels", subject.scene.pictures[use->picture].width,
                                    subject.scene.pictures[use->picture].height)
                      : "");
}

/// What the material or the morph targets state, but the mesh gives nothing to draw it by: told as effects
/// that no family has.
void add_losses_of_mesh(const Subject& subject, std::vector<Effect>& effects) {
    const Primitive& primitive = subject.primitive;
    const auto lose = [&](const std::string& name, std::string reason) {
        effects.push_back({name, name, "", true, std::move(reason)});
    };
    for (const std::string& attribute : primitive.targets_not_read)
        lose("morph targets of " + attribute, "its mesh has them");
    for (std::size_t map = 0; map < kMapFeatures.size(); ++map) {
        const std::optional<TextureUse>& use = subject.material.physical.maps[map];
        const auto is_lost = [&](const Effect& effect) {
            return effect.name == kMapFeatures[map] && effect.reason == why_not_placed(use->set);
        };
        if (use && std::ranges::any_of(effects, is_lost))
            lose(fmt::format("{} of a mesh without TEXCOORD_{}", kMapFeatures[map], use->set),
                 "its material states it");
    }
    const bool is_brushed = subject.material.physical.of_extensions.at("Material.anisotropy").front() > 0;
    if (is_brushed && !subject.material.unlit && primitive.tangents.empty())
        lose("anisotropy of a mesh with neither tangents nor texture coordinates", "its material states it");
}

/// Whether a float's 1 - (d / range)^4 may be less than 1 at some distance to the bounds: it rounds to 1
/// where the power is below 2^-25, and half of that is asked for, as the distance is rounded too.
bool may_dim(const PlacedLight& light, const std::optional<Box>& bounds) {
    return !bounds ||
           std::pow(greatest_distance(light.positions, *bounds) / light.light->range, 4) >= std::exp2(-26);
}

/// The end of local lights, where any is in that has one. `effects` begin with the lights'.
Effect judge_light_range(const Subject& subject, const std::vector<PlacedLight>& lights,
                         const std::vector<Effect>& effects) {
    const PlacedLight* with_end = nullptr;
    bool is_seen = false;
    for (std::size_t i = 0; i < lights.size() && !is_seen; ++i) {
        if (!effects[i].is_in || !has_end(*lights[i].light)) continue;
        with_end = &lights[i];
        is_seen = may_dim(lights[i], subject.draw.bounds);
    }
    if (with_end == nullptr)
        return {"light_range", "light_range", "windowed", false, "no local light with a range is in"};
    return {"light_range", "light_range", "windowed", is_seen,
            fmt::format("{} ends at {:.3g}{}", with_end->label, with_end->light->range,
                        is_seen ? "" : ", too far away to dim it by a float's rounding")};
}

/// What a metallic-roughness material decides, once the lights are judged.
void judge_physical_surface(const Subject& subject, const std::vector<PlacedLight>& lights,
                            const EyePlace& eye, double fog_threshold, std::vector<Effect>& effects) {
    const Overrides& overrides = subject.overrides;
    const Material& material = subject.material;
    const PhysicalMaterial& physical = material.physical;
    const std::string probe = overrides.probe ? overrides.probe->kind : "none";
    const double reflection = overrides.reflection.value_or(0);
    const Objection unlit{material.unlit, "its material is unlit"};
    effects.push_back(decide("unlit", "lighting", "base_color", {{!material.unlit, "it is not asked for"}},
                             "its material is marked unlit"));
    bool is_placed = false;
    for (std::size_t map = 0; map < kMapFeatures.size(); ++map) {
        effects.push_back(judge_map(subject, static_cast<MapKind>(map)));
        is_placed = is_placed || (effects.back().is_in && physical.maps[map]->is_placed());
    }
    const bool reflects =
        physical.metallic > 0 || physical.dielectric_edge > 0 || !is_black(physical.dielectric);
    effects.insert(
        effects.end(),
        {decide("texture_placement", "texture_placement", "placed",
                {{!is_placed, "all pictures lie by the first texture coordinates"}},
                "a picture is transformed, or lies by the second texture coordinates"),
         judge_light_range(subject, lights, effects), judge_fog(subject, eye, fog_threshold),
         judge_sides(material), judge_cutout(subject),
         judge_vertex_color(subject.primitive, material, glm::dvec3(physical.base_color)),
         decide("probe", "ambient", probe, {{probe == "none", "not asked for"}, unlit},
                subject.scene.has_no_light ? "the scene states no light: the studio stands in" : probe),
         decide("reflection", "reflection", "image",
                {{reflection == 0, "not asked for"}, {!reflects, "its material mirrors nothing"}, unlit},
                subject.scene.has_no_light ? "the scene states no light: the studio stands in"
                                           : fmt::format("a share of {:.3g}", reflection))});
    for (const MaterialExtension& extension : material_extensions()) {
        const bool is_seen = subject.is_lit || (extension.seen_by != SeenBy::lights && reflection > 0) ||
                             (extension.seen_by == SeenBy::probes && overrides.probe);
        const ExtensionProperty& amount = extension.properties.front();
        const double most = std::ranges::max(physical.of_extensions.at(amount.uniform));
        effects.push_back(decide(extension.feature, extension.feature, extension.value,
                                 {{most == 0, "it has none"}, {!is_seen, "no light is in"}, unlit},
                                 fmt::format("{} of {:.3g}", amount.name, most)));
    }
    for (const std::string& name : physical.not_drawn)
        effects.push_back({name, name, "", true, "its material states it"});
    add_losses_of_mesh(subject, effects);
    for (const auto& [feature, value] : overrides.quality)
        effects.push_back({feature, feature, value, true, "asked for"});
}

/// A surface may shade itself unless it is flat.
bool may_shade_itself(const Draw& draw) {
    return !draw.bounds || glm::all(glm::lessThan(draw.bounds->low, draw.bounds->high));
}

/// Whether no plane along the light's direction parts the two: seen from the light they may lie on each
/// other. The planes tried are those that contain the direction and an axis of the world, which are all that
/// can part the shadows of two boxes.
bool may_overlap_along(const glm::dvec3& direction, const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 unit(0);
        unit[axis] = 1;
        const glm::dvec3 across = glm::cross(direction, unit);
        const Interval of_a = extent_of(a, across);
        const Interval of_b = extent_of(b, across);
        if (of_a.high < of_b.low || of_b.high < of_a.low) return false;
    }
    return true;
}

/// Whether a part of the box may lie on a segment between two points of `between`, not just at its ends:
/// where the box only touches the other from outside, it shades nothing.
bool may_lie_within(const Box& box, const Box& between) {
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_flat = between.low[axis] == between.high[axis];
        const bool is_beside = box.high[axis] < between.low[axis] || box.low[axis] > between.high[axis];
        const bool touches = box.high[axis] <= between.low[axis] || box.low[axis] >= between.high[axis];
        if (is_beside || (touches && !is_flat)) return false;
    }
    return true;
}

/// Whether a caster may stand between the light and the receiver: it must reach into the box around both or,
/// for a directional light, not lie wholly behind the receiver nor beside it.
bool may_stand_between(const PlacedLight& light, const Draw& caster, const Draw& receiver) {
    if (!caster.bounds || !receiver.bounds) return true;
    if (light.light->kind != LightKind::directional) {
        Box between = light.positions;
        between.add(*receiver.bounds);
        return may_lie_within(*caster.bounds, between);
    }
    if (light.turns) return true;
    const glm::dvec3 toward = -light.direction;
    return extent_of(*caster.bounds, toward).high > extent_of(*receiver.bounds, toward).low &&
           may_overlap_along(toward, *caster.bounds, *receiver.bounds);
}

/// The shadow of each light that casts any. The subject's lights must have been judged; `draws` are those of
/// the scene, with their bounds, and `lights` stand in the order of the draw's first effects.
void judge_shadows(const Subject& subject, const std::vector<PlacedLight>& lights,
                   const std::vector<Draw>& draws, std::vector<Effect>& effects) {
    const std::size_t others = effects.size();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const PlacedLight& light = lights[i];
        if (!light.light->casts_shadow) continue;
        const bool receives = subject.overrides.shadow.value_or(true);
        const bool is_light_in = effects[i].is_in;
        const auto caster = std::ranges::find_if(draws, [&](const Draw& draw) {
            if (!receives || !is_light_in || !draw.excluded.empty()) return false;
            if (!casts_shadow(subject.scene, draw)) return false;
            return &draw == &subject.draw ? may_shade_itself(draw)
                                          : may_stand_between(light, draw, subject.draw);
        });
        effects.push_back(
            decide("shadow of " + light.label, light.feature + "_shadows", "",
                   {{!receives, "it receives none"},
                    {!is_light_in, "the light is out"},
                    {caster == draws.end(), "nothing can shade it"}},
                   caster == draws.end() ? "" : fmt::format("'{}' may shade it", caster->name)));
    }
    if (effects.size() == others) effects.push_back({"shadow", "shadow", "", false, "no light casts any"});
}

std::string why_excluded(const Scene& scene, const Primitive& primitive, const Material& material) {
    if (primitive.topology == Topology::points) return "its primitives are points";
    if (primitive.topology == Topology::lines) return "its primitives are lines";
    if (primitive.indices.empty()) return "it has no triangles";
    if (material.alpha_mode == AlphaMode::mask &&
        alpha_range(scene, primitive, material).high < material.alpha_cutoff)
        return "all of it is more transparent than its material's alphaCutoff";
    return "";
}

std::vector<Draw> draws_of(const Scene& scene) {
    std::vector<Draw> draws;
    for (const std::size_t index : scene.order) {
        const Node& node = scene.nodes[index];
        if (!node.mesh) continue;
        const std::vector<Primitive>& primitives = scene.meshes[*node.mesh].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            Draw& draw = draws.emplace_back(Draw{index, i, node.name, {}, {}, {}});
            if (node.name.empty()) draw.name = fmt::format("node {}", index);
            if (primitives.size() > 1) draw.name += fmt::format(", primitive {}", i);
            draw.excluded = why_excluded(scene, primitives[i], scene.materials[primitives[i].material]);
            if (draw.excluded.empty()) draw.bounds = world_bounds(scene, index, primitives[i]);
        }
    }
    return draws;
}

}  // namespace

std::vector<PlacedLight> place_lights(const Scene& scene) {
    std::vector<PlacedLight> lights;
    std::array<int, kLightKinds.size()> counts{};
    for (const std::size_t index : scene.order) {
        const Node& node = scene.nodes[index];
        if (!node.light) continue;
        const Light& light = scene.lights[*node.light];
        const auto kind = static_cast<std::size_t>(light.kind);
        lights.push_back({&light, index, kLightKinds[kind],
                          fmt::format("{} {}", kLightKinds[kind], counts[kind]++),
                          world_box(scene, index, {glm::dvec3(0), glm::dvec3(0)}), is_moving(scene, index),
                          unit_or_zero(glm::dmat3(node.world) * glm::dvec3(0, 0, -1))});
    }
    return lights;
}

const Primitive& primitive_of(const Scene& scene, const Draw& draw) {
    return scene.meshes[*scene.nodes[draw.node].mesh].primitives[draw.primitive];
}

const Material& material_of(const Scene& scene, const Draw& draw) {
    return scene.materials[primitive_of(scene, draw).material];
}

bool casts_shadow(const Scene& scene, const Draw& draw) {
    return !scene.is_physical || material_of(scene, draw).alpha_mode != AlphaMode::blend;
}

Overrides overrides_of(const Scene& scene, const Draw& draw) {
    Overrides overrides = material_of(scene, draw).overrides;
    overrides.fill_from(scene.nodes[draw.node].overrides);
    return overrides;
}

EyePlace eye_of_cameras(const Scene& scene, std::optional<std::size_t> camera) {
    Box places;
    for (const std::size_t index : scene.order) {
        const auto& here = scene.nodes[index].camera;
        if (here && (!camera || here == camera))
            places.add(world_box(scene, index, {glm::dvec3(0), glm::dvec3(0)}));
    }
    return places.is_empty() ? EyePlace() : places;
}

SceneDraws::SceneDraws(const Scene& scene, const EyePlace& eye, const Thresholds& thresholds)
    : scene_(scene),
      eye_(eye),
      thresholds_(thresholds),
      draws_(draws_of(scene)),
      lights_(place_lights(scene)) {}

Draw SceneDraws::judged(std::size_t index) const {
    const Draw& draw = draws_[index];
    Draw judged = draw;
    if (!draw.excluded.empty()) return judged;
    Subject subject{
        scene_, draw, primitive_of(scene_, draw), material_of(scene_, draw), overrides_of(scene_, draw), {}};
    subject.normals = fixed_normals(subject);
    judge_lights(subject, lights_, thresholds_.light, judged.effects);
    subject.is_lit = std::ranges::any_of(judged.effects, &Effect::is_in);
    if (scene_.is_physical)
        judge_physical_surface(subject, lights_, eye_, thresholds_.fog, judged.effects);
    else
        judge_surface(subject, eye_, thresholds_.fog, judged.effects);
    judge_shadows(subject, lights_, draws_, judged.effects);
    return judged;
}

std::vector<Draw> required_effects(const Scene& scene, const EyePlace& eye, const Thresholds& thresholds) {
    const SceneDraws draws(scene, eye, thresholds);
    std::vector<Draw> judged;
    for (std::size_t i = 0; i < draws.size(); ++i) judged.push_back(draws.judged(i));
    return judged;
}

}  // namespace gobo::scene
