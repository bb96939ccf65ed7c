// Materials, the alpha of pictures that cut them, and what `extras.gobo` overrides.
#include <algorithm>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/read_parts.hpp"
#include "scene/textures.hpp"

namespace gobo::scene {
namespace {

/// The share of light that a dielectric reflects head-on, at the index of refraction 1.5 (glTF 2.0
/// specification, B.2).
constexpr double kDielectricReflectance = 0.04;
/// The family's bounds on Material.strength; a highlight's shininess is bounded by it too, as they grow
/// together.
constexpr double kMostStrength = 1e3;

const std::vector<std::string> kFogKinds = {"none", "linear", "exponential", "exponential_squared"};
const std::vector<std::string> kProbeKinds = {"none", "hemisphere", "spherical_harmonics", "image"};
const std::vector<std::string> kHighlights = {"none", "phong", "blinn"};

/// docs/scene_format.md, "Materials", states this rule and where it comes from.
void read_surface(const Value& value, const Textures& textures, Material& material) {
    glm::dvec4 factor(1);
    double metallic = 1;
    double roughness = 1;
    double emissive_strength = 1;
    double specular_factor = 1;
    glm::dvec3 specular_color(1);
    const Value model = value["pbrMetallicRoughness"].object();
    model["baseColorFactor"].read_numbers(&factor.x, 4);
    if (glm::clamp(factor, 0.0, 1.0) != factor)
        model["baseColorFactor"].fail("holds a number that is not between 0 and 1");
    model["metallicFactor"].read(metallic, kUpToOne);
    material.is_metal = model["metallicFactor"] && metallic > 0;
    model["roughnessFactor"].read(roughness, kUpToOne);
    const bool has_roughness_texture = textures.is_named(model["metallicRoughnessTexture"]);
    material.is_textured = textures.is_named(model["baseColorTexture"]) || has_roughness_texture;
    if (material.alpha_mode == AlphaMode::mask) material.opacity = textures.alpha(model["baseColorTexture"]);
    const Value extensions = value["extensions"].object();
    material.unlit = static_cast<bool>(extensions["KHR_materials_unlit"].object());
    extensions["KHR_materials_emissive_strength"]["emissiveStrength"].read(emissive_strength, kBrightness);
    const Value specular = extensions["KHR_materials_specular"];
    specular["specularFactor"].read(specular_factor, kUpToOne);
    specular["specularColorFactor"].read_color(specular_color);

    const glm::dvec3 base(factor);
    material.alpha = factor.a;
    material.emission *= emissive_strength;
    if (material.unlit) {  // KHR_materials_unlit: the base colour is what is seen
        material.emission = base;
        return;
    }
    const glm::dvec3 dielectric =
        glm::min(kDielectricReflectance * specular_color, glm::dvec3(1)) * specular_factor;
    const glm::dvec3 reflectance = glm::mix(dielectric, base, metallic);
    material.diffuse = base * (1 - metallic);
    const double alpha = roughness * roughness;
    const double shininess = alpha == 0 ? 8 * kMostStrength : 2 / (alpha * alpha) - 2;
    if (shininess >= 1 || has_roughness_texture) {
        material.shininess = std::clamp(shininess, 1.0, 8 * kMostStrength - 2);
        material.strength = (material.shininess + 2) / 8;
        material.specular = reflectance;
    } else {  // too rough for a highlight: what it reflects goes everywhere, as diffuse light does
        material.diffuse = glm::min(material.diffuse + reflectance, glm::dvec3(1));
    }
    material.ambient = material.diffuse;
}

/// The model stated outright takes the place of what the rule gives.
void read_material_extras(const Value& value, Material& material) {
    const Value extras = value.gobo_extras();
    material.overrides = read_overrides(extras, {"model"});
    const Value model = extras["model"].object();
    if (!model) return;
    model.only({"ambient", "diffuse", "shininess", "specular", "strength"});
    model["diffuse"].read_color(material.diffuse);
    material.ambient = material.diffuse;
    material.strength = 1;
    material.is_metal = false;
    model["ambient"].read_color(material.ambient);
    model["specular"].read_color(material.specular);
    model["shininess"].read(material.shininess, {0, 1e6});
    model["strength"].read(material.strength, {0, kMostStrength});
}

Material read_material(const Value& value, Textures& textures, bool is_physical) {
    Material material;
    value["name"].read(material.name);
    value["emissiveFactor"].read_color(material.emission);
    if (glm::clamp(material.emission, 0.0, 1.0) != material.emission)
        value["emissiveFactor"].fail_with("KHR_materials_emissive_strength states more",
                                          "holds a number that is not between 0 and 1");
    value["doubleSided"].read(material.double_sided);
    material.alpha_mode = static_cast<AlphaMode>(value["alphaMode"].choice({"OPAQUE", "MASK", "BLEND"}, 0));
    value["alphaCutoff"].read(material.alpha_cutoff, kNotNegative);
    read_surface(value, textures, material);
    read_material_extras(value, material);
    if (is_physical) material.physical = read_physical(value, textures);
    for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        material.is_textured = textures.is_named(value[texture]) || material.is_textured;
    return material;
}

Fog read_fog(const Value& value) {
    Fog fog;
    value.only({"color", "density", "far", "kind", "near"});
    fog.kind = kFogKinds[value["kind"].choice(kFogKinds)];
    value["color"].read_color(fog.color);
    value["near"].read(fog.near, kNotNegative);
    value["far"].read(fog.far, kNotNegative);
    value["density"].read(fog.density, kNotNegative);
    if (fog.kind == "linear" && fog.far < fog.near)
        value["far"].fail("is {:g}, nearer than near, {:g}", fog.far, fog.near);
    return fog;
}

Probe read_probe(const Value& value) {
    Probe probe;
    value.only({"coefficients", "ground", "kind", "scale", "share", "sky", "up"});
    probe.kind = kProbeKinds[value["kind"].choice(kProbeKinds)];
    value["up"].read(probe.up);
    const double length = glm::length(probe.up);
    if (!(length > 1e-6 && length < 1e6)) value["up"].fail("is not a direction");
    probe.up /= length;
    value["sky"].read_color(probe.sky);
    value["ground"].read_color(probe.ground);
    probe.scale = 1 / std::numbers::pi;  // then what the polynomial gives is the radiance of a white surface
    value["scale"].read(probe.scale, {0, 1e3});
    value["share"].read(probe.share, kUpToOne);
    if (probe.kind != "spherical_harmonics") return probe;
    const std::vector<Value> rows = value["coefficients"].elements();
    if (rows.size() != probe.coefficients.size())
        value["coefficients"].fail("must hold 9 colours, not {}", rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].read(probe.coefficients[i]);
    return probe;
}

}  // namespace

void Overrides::fill_from(const Overrides& outer) {
    if (!fog) fog = outer.fog;
    if (!toon_levels) toon_levels = outer.toon_levels;
    if (!specular) specular = outer.specular;
    if (!probe) probe = outer.probe;
    if (!reflection) reflection = outer.reflection;
    if (!shadow) shadow = outer.shadow;
    quality.insert(outer.quality.begin(), outer.quality.end());
}

Overrides read_overrides(const Value& extras, std::vector<std::string> others) {
    for (const char* name : {"fog", "probe", "quality", "reflection", "shadow", "specular", "toon"})
        others.emplace_back(name);
    extras.only(others);
    Overrides overrides;
    if (const Value fog = extras["fog"].object()) overrides.fog = read_fog(fog);
    if (const auto levels = extras["toon"].integer()) {
        overrides.toon_levels = static_cast<int>(*levels);
        if (*levels < 0 || *levels > 64)
            extras["toon"].fail("is {}, but must be between 0 and 64 levels", *levels);
    }
    if (extras["specular"]) overrides.specular = kHighlights[extras["specular"].choice(kHighlights)];
    if (const Value probe = extras["probe"].object()) overrides.probe = read_probe(probe);
    extras["reflection"].read(overrides.reflection, kUpToOne);
    // Which features there are is the family's to say, and the key's to find out.
    if (const Value quality = extras["quality"].object())
        for (const auto& [feature, chosen] : quality.json->items())
            quality[feature].read(overrides.quality[feature]);
    extras["shadow"].read(overrides.shadow);
    return overrides;
}

void read_materials(const Value& root, const Accessors& accessors, const FileSystem& disk, Scene& scene) {
    Textures textures(root, accessors, disk, scene);
    for (const Value& value : root["materials"].objects())
        scene.materials.push_back(read_material(value, textures, scene.is_physical));
    // What stands where nothing is stated.
    scene.materials.push_back(read_material({}, textures, scene.is_physical));
    scene.materials.back().name = "default material";
}

}  // namespace gobo::scene
