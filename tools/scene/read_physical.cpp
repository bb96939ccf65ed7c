// Metallic-roughness materials in their own terms: glTF 2.0, 3.9, and its extensions.
#include <algorithm>

#include <glm/common.hpp>

#include "scene/material_extensions.hpp"
#include "scene/textures.hpp"

namespace gobo::scene {
namespace {

/// The bounds of Material.normalScale in templates/pbr.toml.
constexpr double kMostNormalScale = 10;

/// What Fresnel's equations give head-on, from air; the extension's 0 stands for all of it.
double reflectance_of(double ior) {
    if (ior == 0) return 1;
    const double root = (ior - 1) / (ior + 1);
    return root * root;
}

/// Pictures of extensions, by their names, which no family looks up.
void note_pictures(const Value& extension, const std::vector<const char*>& names,
                   PhysicalMaterial& material) {
    for (const char* name : names)
        if (extension[name]) material.not_drawn.emplace_back(name);
}

/// What the extension states, or its initial numbers where the material is without it.
void read_extension(const MaterialExtension& extension, const Value& value, PhysicalMaterial& material) {
    for (const ExtensionProperty& property : extension.properties) {
        std::vector<double> numbers = property.initial;
        if (numbers.size() == 3) {
            glm::dvec3 color(numbers[0], numbers[1], numbers[2]);
            value[property.name].read_color(color);
            if (std::max({color.r, color.g, color.b}) > property.range.high)
                value[property.name].fail("holds a number that is not between 0 and {:g}",
                                          property.range.high);
            numbers = {color.r, color.g, color.b};
        } else {
            value[property.name].read(numbers.front(), property.range);
        }
        if (property.to_uniform != nullptr) numbers = property.to_uniform(numbers.front());
        material.of_extensions[property.uniform] = std::move(numbers);
    }
    note_pictures(value, extension.pictures, material);
}

}  // namespace

PhysicalMaterial read_physical(const Value& value, Textures& textures) {
    PhysicalMaterial material;
    const Value model = value["pbrMetallicRoughness"].object();
    model["baseColorFactor"].read_numbers(&material.base_color.x, 4);
    model["metallicFactor"].read(material.metallic, kUpToOne);
    model["roughnessFactor"].read(material.roughness, kUpToOne);
    double normal_scale = 1;
    value["normalTexture"]["scale"].read(normal_scale);
    material.normal_scale = std::clamp(normal_scale, -kMostNormalScale, kMostNormalScale);
    if (material.normal_scale != normal_scale)
        material.not_drawn.push_back(fmt::format("normalTexture.scale {:g} (it is drawn as {:g})",
                                                 normal_scale, material.normal_scale));
    value["occlusionTexture"]["strength"].read(material.occlusion_strength, kUpToOne);
    const auto use = [&](const Value& of, const char* name) {
        auto picture = textures.use(of[name]);
        if (picture && picture->set > 1)
            material.not_drawn.push_back(fmt::format("{} by texCoord {}", name, picture->set));
        if (!picture && of[name])
            material.not_drawn.push_back(fmt::format("{} {}", name, textures.why_unused(of[name])));
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

    for (const MaterialExtension& extension : material_extensions())
        read_extension(extension, extensions[extension.name], material);

    const std::vector<std::string> read = read_material_extensions();
    if (extensions)
        for (const auto& [name, extension] : extensions.json->items())
            if (std::ranges::find(read, name) == read.end()) material.not_drawn.push_back(name);
    return material;
}

}  // namespace gobo::scene
