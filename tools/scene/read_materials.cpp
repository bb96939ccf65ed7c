#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// The share of light that a dielectric reflects head-on, at the index of refraction 1.5 (glTF 2.0
/// specification, B.2).
constexpr double dielectric_reflectance = 0.04;
/// The family's bounds on Material.strength; a highlight's shininess is bounded by it too, as they grow
/// together.
constexpr double most_strength = 1e3;

/// glTF's metallic and roughness.
struct Surface {
    glm::dvec3 base{1};
    double metallic = 1;
    double roughness = 1;
    double specular_factor = 1;
    glm::dvec3 specular_color{1};
    bool has_roughness_texture = false;
};

/// docs/scene_format.md, "Materials", states this rule and where it comes from.
void apply_surface(const Surface& surface, Material& material) {
    if (material.unlit) {  // KHR_materials_unlit: the base colour is what is seen
        material.emission = surface.base;
        return;
    }
    const glm::dvec3 dielectric =
        glm::min(dielectric_reflectance * surface.specular_color, glm::dvec3(1)) * surface.specular_factor;
    const glm::dvec3 reflectance = glm::mix(dielectric, surface.base, surface.metallic);
    material.diffuse = surface.base * (1 - surface.metallic);
    const double alpha = surface.roughness * surface.roughness;
    const double shininess = alpha == 0 ? 8 * most_strength : 2 / (alpha * alpha) - 2;
    const bool has_highlight = shininess >= 1 || surface.has_roughness_texture;
    if (has_highlight) {
        material.shininess = std::clamp(shininess, 1.0, 8 * most_strength - 2);
        material.strength = (material.shininess + 2) / 8;
        material.specular = reflectance;
    } else {  // too rough for a highlight: what it reflects goes everywhere, as scattered light does
        material.diffuse = glm::min(material.diffuse + reflectance, glm::dvec3(1));
    }
    material.ambient = material.diffuse;
}

Surface read_surface(Document& document, Textures& textures, const Value& value, Material& material) {
    Surface surface;
    const auto model = document.object(value, "pbrMetallicRoughness");
    if (!model) return surface;
    if (const auto factor = document.numbers(*model, "baseColorFactor", 4)) {
        surface.base = {(*factor)[0], (*factor)[1], (*factor)[2]};
        material.alpha = (*factor)[3];
        for (const double part : *factor) {
            if (part >= 0 && part <= 1) continue;
            document.error(path_to(*model, "baseColorFactor"), "holds a number that is not between 0 and 1");
        }
    }
    surface.metallic = document.number_within(*model, "metallicFactor", 0, 1).value_or(1);
    surface.roughness = document.number_within(*model, "roughnessFactor", 0, 1).value_or(1);
    surface.has_roughness_texture = textures.is_named(*model, "metallicRoughnessTexture");
    material.is_textured = textures.is_named(*model, "baseColorTexture") || surface.has_roughness_texture;
    if (material.alpha_mode == AlphaMode::mask) material.opacity = textures.alpha(*model, "baseColorTexture");
    return surface;
}

void read_extensions(Document& document, const Value& value, Surface& surface, Material& material) {
    const auto extensions = document.object(value, "extensions");
    if (!extensions) return;
    material.unlit = document.object(*extensions, "KHR_materials_unlit").has_value();
    if (const auto strength = document.object(*extensions, "KHR_materials_emissive_strength")) {
        constexpr double unbounded = std::numeric_limits<double>::infinity();
        material.emission *= document.number_within(*strength, "emissiveStrength", 0, unbounded).value_or(1);
    }
    if (const auto specular = document.object(*extensions, "KHR_materials_specular")) {
        surface.specular_factor = document.number_within(*specular, "specularFactor", 0, 1).value_or(1);
        surface.specular_color =
            read_color(document, *specular, "specularColorFactor").value_or(glm::dvec3(1));
    }
}

/// The model stated outright takes the place of what the rule gives.
void read_material_extras(Document& document, const Value& value, Material& material) {
    const auto extras = gobo_extras(document, value);
    if (!extras) return;
    material.overrides = read_overrides(document, *extras, {"model"});
    const auto model = document.object(*extras, "model");
    if (!model) return;
    document.only(*model, {"ambient", "diffuse", "shininess", "specular", "strength"});
    material.diffuse = read_color(document, *model, "diffuse").value_or(material.diffuse);
    material.ambient = read_color(document, *model, "ambient").value_or(material.diffuse);
    material.specular = read_color(document, *model, "specular").value_or(material.specular);
    material.shininess = document.number_within(*model, "shininess", 0, 1e6).value_or(material.shininess);
    material.strength = document.number_within(*model, "strength", 0, most_strength).value_or(1);
}

AlphaMode read_alpha_mode(Document& document, const Value& value) {
    const auto mode = document.choice(value, "alphaMode", {"OPAQUE", "MASK", "BLEND"});
    if (mode == "MASK") return AlphaMode::mask;
    return mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

Material read_material(Document& document, Textures& textures, const Value& value) {
    Material material;
    material.name = document.string(value, "name").value_or("");
    material.emission = read_color(document, value, "emissiveFactor").value_or(glm::dvec3(0));
    material.double_sided = document.boolean(value, "doubleSided").value_or(false);
    material.alpha_mode = read_alpha_mode(document, value);
    material.alpha_cutoff =
        document.number_within(value, "alphaCutoff", 0, std::numeric_limits<double>::infinity())
            .value_or(0.5);
    Surface surface = read_surface(document, textures, value, material);
    read_extensions(document, value, surface, material);
    apply_surface(surface, material);
    read_material_extras(document, value, material);
    for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        material.is_textured = textures.is_named(value, texture) || material.is_textured;
    return material;
}

}  // namespace

/// The last one is glTF's default material, for primitives that name none.
void read_materials(Document& document, Textures& textures, Scene& scene) {
    for (const Value& value : document.objects(document.root(), "materials"))
        scene.materials.push_back(read_material(document, textures, value));
    Material standard;
    standard.name = "default material";
    apply_surface({}, standard);
    scene.materials.push_back(std::move(standard));
}

}  // namespace gobo::scene
