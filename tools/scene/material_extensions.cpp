#include "scene/material_extensions.hpp"

#include <cmath>

namespace gobo::scene {
namespace {

/// The direction of a brush, by tangent and bitangent.
std::vector<double> direction_of_angle(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

const std::vector<MaterialExtension>& material_extensions() {
    static const std::vector<MaterialExtension> kExtensions = {
        {"KHR_materials_clearcoat",
         "clearcoat",
         "layer",
         {{"clearcoatFactor", "Material.clearcoat", {0}},
          {"clearcoatRoughnessFactor", "Material.clearcoatRoughness", {0}}},
         {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"},
         SeenBy::probes},
        {"KHR_materials_sheen",
         "sheen",
         "charlie",
         {{"sheenColorFactor", "Material.sheenColor", {0, 0, 0}},
          {"sheenRoughnessFactor", "Material.sheenRoughness", {0}}},
         {"sheenColorTexture", "sheenRoughnessTexture"},
         SeenBy::probes},
        {"KHR_materials_anisotropy",
         "anisotropy",
         "brushed",
         {{"anisotropyStrength", "Material.anisotropy", {0}},
          {"anisotropyRotation", "Material.anisotropyDirection", {0}, {}, direction_of_angle}},
         {"anisotropyTexture"},
         SeenBy::lights},
        {"KHR_materials_iridescence",
         "iridescence",
         "thin_film",
         {{"iridescenceFactor", "Iridescence.factor", {0}},
          {"iridescenceIor", "Iridescence.ior", {1.3}, {1}},
          {"iridescenceThicknessMaximum", "Iridescence.thickness", {400}, kNotNegative}},
         {"iridescenceTexture", "iridescenceThicknessTexture"},
         SeenBy::reflection}};
    return kExtensions;
}

std::vector<std::string> read_material_extensions() {
    std::vector<std::string> names = {"KHR_materials_emissive_strength", "KHR_materials_ior",
                                      "KHR_materials_specular", "KHR_materials_unlit"};
    for (const MaterialExtension& extension : material_extensions()) names.emplace_back(extension.name);
    return names;
}

}  // namespace gobo::scene
