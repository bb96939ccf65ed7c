// The members of a sample that shaders read, by the names that `lit` reads them by.
#pragma once

#include <array>
#include <tuple>
#include <type_traits>
#include <utility>

#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// A number, vector, matrix or small array of numbers: what has no members.
template <class Value>
inline constexpr bool kIsNumbers =
    std::is_arithmetic_v<Value> || std::is_same_v<Value, std::array<double, 3>>;
template <glm::length_t size>
inline constexpr bool kIsNumbers<glm::vec<size, double>> = true;
template <glm::length_t columns, glm::length_t rows>
inline constexpr bool kIsNumbers<glm::mat<columns, rows, double>> = true;

/// Of a struct: pairs of a name and a pointer to the member. Members without a name stand for their own
/// members.
template <class Owner>
inline constexpr auto kMembers = 0;

template <>
inline constexpr auto kMembers<oracle::Material> = std::tuple(
    std::pair("emission", &oracle::Material::emission), std::pair("ambient", &oracle::Material::ambient),
    std::pair("diffuse", &oracle::Material::diffuse), std::pair("specular", &oracle::Material::specular),
    std::pair("shininess", &oracle::Material::shininess), std::pair("strength", &oracle::Material::strength),
    std::pair("baseColor", &oracle::Material::base_color), std::pair("metallic", &oracle::Material::metallic),
    std::pair("roughness", &oracle::Material::roughness),
    std::pair("dielectric", &oracle::Material::dielectric),
    std::pair("dielectricEdge", &oracle::Material::dielectric_edge),
    std::pair("sheenColor", &oracle::Material::sheen_color),
    std::pair("sheenRoughness", &oracle::Material::sheen_roughness),
    std::pair("anisotropyDirection", &oracle::Material::anisotropy_direction),
    std::pair("anisotropy", &oracle::Material::anisotropy),
    std::pair("clearcoat", &oracle::Material::clearcoat),
    std::pair("clearcoatRoughness", &oracle::Material::clearcoat_roughness),
    std::pair("normalScale", &oracle::Material::normal_scale),
    std::pair("occlusionStrength", &oracle::Material::occlusion_strength));
template <>
inline constexpr auto kMembers<oracle::TexturePlacement> = std::tuple(
    std::pair("linear", &oracle::TexturePlacement::linear),
    std::pair("offset", &oracle::TexturePlacement::offset), std::pair("set", &oracle::TexturePlacement::set));
template <>
inline constexpr auto kMembers<oracle::DirectionalLight> =
    std::tuple(std::pair("direction", &oracle::DirectionalLight::direction),
               std::pair("color", &oracle::DirectionalLight::color));
template <>
inline constexpr auto kMembers<oracle::PointLight> = std::tuple(
    std::pair("position", &oracle::PointLight::position), std::pair("color", &oracle::PointLight::color),
    std::pair("attenuation", &oracle::PointLight::attenuation),
    std::pair("nearness", &oracle::PointLight::nearness));
template <>
inline constexpr auto kMembers<oracle::SpotLight> =
    std::tuple_cat(kMembers<oracle::PointLight>,
                   std::tuple(std::pair("axis", &oracle::SpotLight::axis),
                              std::pair("exponent", &oracle::SpotLight::exponent),
                              std::pair("innerOneMinusCosine", &oracle::SpotLight::inner_one_minus_cosine),
                              std::pair("outerOneMinusCosine", &oracle::SpotLight::outer_one_minus_cosine)));
template <>
inline constexpr auto kMembers<oracle::DirectionalOrPointLight> =
    std::tuple(std::pair("position", &oracle::DirectionalOrPointLight::position),
               std::pair("color", &oracle::DirectionalOrPointLight::color),
               std::pair("attenuation", &oracle::DirectionalOrPointLight::attenuation));
template <>
inline constexpr auto kMembers<oracle::Shadow> = std::tuple(
    std::pair("toMap", &oracle::Shadow::to_map), std::pair("layer", &oracle::Shadow::layer),
    std::pair("depthScale", &oracle::Shadow::depth_scale),
    std::pair("depthShift", &oracle::Shadow::depth_shift), std::pair("spread", &oracle::Shadow::spread));
template <>
inline constexpr auto kMembers<oracle::HemisphereLight> =
    std::tuple(std::pair("up", &oracle::HemisphereLight::up), std::pair("sky", &oracle::HemisphereLight::sky),
               std::pair("ground", &oracle::HemisphereLight::ground));
template <>
inline constexpr auto kMembers<oracle::HarmonicsLight> =
    std::tuple(std::pair("toProbe", &oracle::HarmonicsLight::to_probe),
               std::pair("coefficients", &oracle::HarmonicsLight::coefficients),
               std::pair("scale", &oracle::HarmonicsLight::scale));
template <>
inline constexpr auto kMembers<oracle::ImageLight> = std::tuple(
    std::pair("color", &oracle::ImageLight::color), std::pair("weight", &oracle::ImageLight::weight),
    std::pair("toMap", &oracle::ImageLight::to_map),
    std::pair("roughestLevel", &oracle::ImageLight::roughest_level));
template <>
inline constexpr auto kMembers<oracle::FogParameters> = std::tuple(
    std::pair("color", &oracle::FogParameters::color), std::pair("density", &oracle::FogParameters::density),
    std::pair("start", &oracle::FogParameters::start), std::pair("end", &oracle::FogParameters::end));
template <>
inline constexpr auto kMembers<oracle::Scene> = std::tuple(
    std::pair("Material", &oracle::Scene::material), std::pair("Materials.rows", &oracle::Scene::materials),
    std::pair("Ambient.color", &oracle::Scene::ambient), std::pair("Hemisphere", &oracle::Scene::hemisphere),
    std::pair("Harmonics", &oracle::Scene::harmonics), std::pair("ImageLight", &oracle::Scene::image_light),
    std::pair("Reflection", &oracle::Scene::reflection),
    std::pair("DirectionalLights.lights", &oracle::Scene::directional),
    std::pair("PointLights.lights", &oracle::Scene::point),
    std::pair("SpotLights.lights", &oracle::Scene::spot),
    std::pair("DirectionalOrPointLights.lights", &oracle::Scene::directional_or_point),
    std::pair("LightAmbients.colors", &oracle::Scene::light_ambients),
    std::pair("Shadows.shadows", &oracle::Scene::shadows),
    std::pair("Toon.levels", &oracle::Scene::toon_levels),
    std::pair("ToonThresholds.thresholds", &oracle::Scene::toon_thresholds),
    std::pair("ToonThresholds.tones", &oracle::Scene::toon_tones),
    std::pair("Cutout.threshold", &oracle::Scene::cutout_threshold), std::pair("Fog", &oracle::Scene::fog),
    std::pair("DepthOffset.offset", &oracle::Scene::depth_offset),
    std::pair("TexturePlacements.maps", &oracle::Scene::placements),
    std::pair("extensionNumbers", &oracle::Scene::extension_numbers));
template <>
inline constexpr auto kMembers<oracle::SurfacePoint> = std::tuple(
    std::pair("eyePosition", &oracle::SurfacePoint::position),
    std::pair("eyeNormal", &oracle::SurfacePoint::normal), std::pair("color", &oracle::SurfacePoint::color),
    std::pair("vertexColor", &oracle::SurfacePoint::color),
    std::pair("texcoord", &oracle::SurfacePoint::texture_coordinate),
    std::pair("textureCoordinate", &oracle::SurfacePoint::texture_coordinate),
    std::pair("texcoord1", &oracle::SurfacePoint::texture_coordinate1),
    std::pair("textureCoordinate1", &oracle::SurfacePoint::texture_coordinate1),
    std::pair("eyeTangent", &oracle::SurfacePoint::tangent),
    std::pair("materialIndex", &oracle::SurfacePoint::material),
    std::pair("flatMaterialIndex", &oracle::SurfacePoint::material),
    std::pair("lightRays", &oracle::SurfacePoint::rays),
    std::pair("lightsHalfways", &oracle::SurfacePoint::halfways));
template <>
inline constexpr auto kMembers<Sample> = std::tuple(
    std::pair("position", &Sample::object_position), std::pair("normal", &Sample::object_normal),
    std::pair("tangent", &Sample::object_tangent), std::pair("Transform.modelView", &Sample::model_view),
    std::pair("Transform.projection", &Sample::projection),
    std::pair("Transform.normalMatrix", &Sample::normal_matrix),
    std::pair("litRadiance", &Sample::lit_radiance), std::pair("flatRadiance", &Sample::lit_radiance),
    std::pair("backRadiance", &Sample::back_radiance), std::pair("flatBackRadiance", &Sample::back_radiance),
    std::pair("gl_FrontFacing", &Sample::is_front_facing), std::pair("handedness", &Sample::handedness),
    std::pair("", &Sample::surface), std::pair("", &Sample::scene));

/// Calls visit(name, pointer) for each member.
template <class Owner, class Visit>
void for_each_member(const Visit& visit) {
    std::apply([&](const auto&... member) { (visit(member.first, member.second), ...); }, kMembers<Owner>);
}

}  // namespace gobo::verify
