// A glTF material on its way into a header made from the family `pbr`: the numbers of its block `Material`,
// and the features that it calls for. C++17; the header's own types are template parameters.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace gobo {

/// The factors of a metallic-roughness material as glTF 2.0 and its extensions name them, at their defaults,
/// and which pictures it has.
struct MetallicRoughness {
    glm::vec4 base_color_factor{1};
    float metallic_factor = 1;
    float roughness_factor = 1;
    glm::vec3 emissive_factor{0};
    float emissive_strength = 1;                ///< KHR_materials_emissive_strength
    float ior = 1.5F;                           ///< KHR_materials_ior; 0: all is reflected
    float specular_factor = 1;                  ///< KHR_materials_specular
    glm::vec3 specular_color_factor{1};         ///< KHR_materials_specular
    float clearcoat_factor = 0;                 ///< KHR_materials_clearcoat
    float clearcoat_roughness_factor = 0;       ///< KHR_materials_clearcoat
    float anisotropy_strength = 0;              ///< KHR_materials_anisotropy
    float anisotropy_rotation = 0;              ///< KHR_materials_anisotropy, radians
    glm::vec3 sheen_color_factor{0};            ///< KHR_materials_sheen
    float sheen_roughness_factor = 0;           ///< KHR_materials_sheen
    float iridescence_factor = 0;               ///< KHR_materials_iridescence
    float iridescence_ior = 1.3F;               ///< KHR_materials_iridescence
    float iridescence_thickness_maximum = 400;  ///< KHR_materials_iridescence, nanometres
    float normal_scale = 1;
    float occlusion_strength = 1;
    bool is_unlit = false;  ///< KHR_materials_unlit

    bool has_base_color_texture = false;
    bool has_metallic_roughness_texture = false;
    bool has_normal_texture = false;  ///< of a mesh with tangents
    bool has_occlusion_texture = false;
    bool has_emissive_texture = false;
};

/// The uniform block: `pbr::Material block = gobo::fill_material<pbr::Material>(material)`. The reflectance
/// head-on is
/// ((ior - 1) / (ior + 1))^2, as KHR_materials_ior has it.
template <class Material>
Material fill_material(const MetallicRoughness& from) {
    const float root = (from.ior - 1) / (from.ior + 1);
    const float head_on = from.ior == 0 ? 1 : root * root;
    Material material{};
    material.baseColor = from.base_color_factor;
    material.emission = from.emissive_strength * from.emissive_factor;
    material.metallic = from.metallic_factor;
    material.roughness = from.roughness_factor;
    material.dielectric = from.specular_factor * glm::min(head_on * from.specular_color_factor, glm::vec3(1));
    material.dielectricEdge = from.specular_factor;
    material.clearcoat = from.clearcoat_factor;
    material.clearcoatRoughness = from.clearcoat_roughness_factor;
    material.anisotropy = from.anisotropy_strength;
    material.anisotropyDirection =
        glm::vec2(std::cos(from.anisotropy_rotation), std::sin(from.anisotropy_rotation));
    material.sheenColor = from.sheen_color_factor;
    material.sheenRoughness = from.sheen_roughness_factor;
    material.normalScale = from.normal_scale;
    material.occlusionStrength = from.occlusion_strength;
    return material;
}

/// The block of a thin film: `gobo::fill_iridescence<pbr::Iridescence_block>(material)`.
template <class Iridescence>
Iridescence fill_iridescence(const MetallicRoughness& from) {
    Iridescence film{};
    film.factor = from.iridescence_factor;
    film.ior = from.iridescence_ior;
    film.thickness = from.iridescence_thickness_maximum;
    return film;
}

/// The key with the features that the material calls for: `pbr::find(gobo::select(material, pbr::Key{}))`.
/// Lights, fog, shadows and environment of `key` stay. A picture that is multiplied by 0 is left out.
template <class Key>
Key select(const MetallicRoughness& from, Key key) {
    const auto choose = [](auto& feature, bool is_in, auto in, auto out) { feature = is_in ? in : out; };
    using Lighting = decltype(key.lighting);
    choose(key.lighting, from.is_unlit, Lighting::base_color, Lighting::metallic_roughness);
    using BaseColor = decltype(key.base_color_map);
    choose(key.base_color_map, from.has_base_color_texture, BaseColor::texture, BaseColor::none);
    using Roughness = decltype(key.metallic_roughness_map);
    choose(key.metallic_roughness_map, from.has_metallic_roughness_texture && !from.is_unlit,
           Roughness::texture, Roughness::none);
    using Normal = decltype(key.normal_map);
    choose(key.normal_map, from.has_normal_texture && from.normal_scale != 0 && !from.is_unlit,
           Normal::tangent, Normal::none);
    using Occlusion = decltype(key.occlusion_map);
    choose(key.occlusion_map, from.has_occlusion_texture && from.occlusion_strength != 0 && !from.is_unlit,
           Occlusion::texture, Occlusion::none);
    using Emissive = decltype(key.emissive_map);
    const bool emits = from.emissive_strength * from.emissive_factor != glm::vec3(0);
    choose(key.emissive_map, from.has_emissive_texture && emits && !from.is_unlit, Emissive::texture,
           Emissive::none);
    using Clearcoat = decltype(key.clearcoat);
    choose(key.clearcoat, from.clearcoat_factor > 0 && !from.is_unlit, Clearcoat::layer, Clearcoat::none);
    using Anisotropy = decltype(key.anisotropy);
    choose(key.anisotropy, from.anisotropy_strength > 0 && !from.is_unlit, Anisotropy::brushed,
           Anisotropy::none);
    using Sheen = decltype(key.sheen);
    choose(key.sheen, from.sheen_color_factor != glm::vec3(0) && !from.is_unlit, Sheen::charlie, Sheen::none);
    using Iridescence = decltype(key.iridescence);
    choose(key.iridescence, from.iridescence_factor > 0 && !from.is_unlit, Iridescence::thin_film,
           Iridescence::none);
    return key;
}

}  // namespace gobo
