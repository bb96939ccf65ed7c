// Metallic-roughness materials in their own terms: glTF 2.0, 3.9, and its extensions.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "scene/textures.hpp"

namespace gobo::scene {
namespace {

/// Extensions of which every part is in a PhysicalMaterial, or that say nothing of their own to see.
const std::vector<std::string> kReadExtensions = {
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
    "KHR_materials_ior",        "KHR_materials_sheen",     "KHR_materials_specular",
    "KHR_materials_unlit"};

/// What Fresnel's equations give head-on, from air; the extension's 0 stands for all of it.
double reflectance_of(double ior) {
    if (ior == 0) return 1;
    const double root = (ior - 1) / (ior + 1);
    return root * root;
}

/// Pictures of extensions, by their names, which no family looks up.
void note_pictures(const Value& extension, std::initializer_list<const char*> names,
                   PhysicalMaterial& material) {
    for (const char* name : names)
        if (extension[name]) material.not_drawn.emplace_back(name);
}

}  // namespace

PhysicalMaterial read_physical(const Value& value, Textures& textures) {
    PhysicalMaterial material;
    const Value model = value["pbrMetallicRoughness"].object();
    model["baseColorFactor"].read_numbers(&material.base_color.x, 4);
    model["metallicFactor"].read(material.metallic, kUpToOne);
    model["roughnessFactor"].read(material.roughness, kUpToOne);
    value["normalTexture"]["scale"].read(material.normal_scale, {-10, 10});
    value["occlusionTexture"]["strength"].read(material.occlusion_strength, kUpToOne);
    const auto use = [&](const Value& of, const char* name) {
        auto picture = textures.use(of[name]);
        if (picture && picture->set > 1)
            material.not_drawn.push_back(fmt::format("{} by texCoord {}", name, picture->set));
        if (!picture && of[name]) material.not_drawn.push_back(fmt::format("{} without source", name));
        return picture;
    };
    material.maps = {use(model, "baseColorTexture"), use(model, "metallicRoughnessTexture"),
                     use(value, "normalTexture"), use(value, "occlusionTexture"),
                     use(value, "emissiveTexture")};
    const Value extensions = value["extensions"].object();

    double ior = 1.5;
    const Value given = extensions["KHR_materials_ior"]["ior"];
    given.read(ior, kNotNegative);
    if (ior > 0 && ior < 1) given.fail("is {:g}, but must be 0 or at least 1", ior);
    double weight = 1;
    glm::dvec3 color(1);
    const Value specular = extensions["KHR_materials_specular"];
    specular["specularFactor"].read(weight, kUpToOne);
    specular["specularColorFactor"].read_color(color);
    note_pictures(specular, {"specularTexture", "specularColorTexture"}, material);
    material.dielectric = glm::min(reflectance_of(ior) * color, glm::dvec3(1)) * weight;
    material.dielectric_edge = weight;

    const Value clearcoat = extensions["KHR_materials_clearcoat"];
    clearcoat["clearcoatFactor"].read(material.clearcoat, kUpToOne);
    clearcoat["clearcoatRoughnessFactor"].read(material.clearcoat_roughness, kUpToOne);
    note_pictures(clearcoat, {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"},
                  material);

    const Value sheen = extensions["KHR_materials_sheen"];
    sheen["sheenColorFactor"].read_color(material.sheen_color);
    sheen["sheenRoughnessFactor"].read(material.sheen_roughness, kUpToOne);
    note_pictures(sheen, {"sheenColorTexture", "sheenRoughnessTexture"}, material);

    const Value anisotropy = extensions["KHR_materials_anisotropy"];
    double rotation = 0;
    anisotropy["anisotropyStrength"].read(material.anisotropy, kUpToOne);
    anisotropy["anisotropyRotation"].read(rotation);
    note_pictures(anisotropy, {"anisotropyTexture"}, material);
    material.anisotropy_direction = {std::cos(rotation), std::sin(rotation)};

    if (extensions)
        for (const auto& [name, extension] : extensions.json->items())
            if (std::ranges::find(kReadExtensions, name) == kReadExtensions.end())
                material.not_drawn.push_back(name);
    return material;
}

}  // namespace gobo::scene
