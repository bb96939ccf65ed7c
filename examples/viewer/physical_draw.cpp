#include "physical_draw.hpp"

#include <algorithm>
#include <string_view>

namespace viewer {
namespace {

using State = pbr::SceneState;

/// What a value of a feature asks of the state.
struct Call {
    std::string_view feature;
    std::string_view value;
    void (*make)(State&);
};

constexpr Call kCalls[] = {
    {"lighting", "base_color", [](State& s) { s.lighting = pbr::Lighting::base_color; }},
    {"base_color_map", "texture", [](State& s) { s.base_color_map = pbr::BaseColorMap::texture; }},
    {"metallic_roughness_map", "texture",
     [](State& s) { s.metallic_roughness_map = pbr::MetallicRoughnessMap::texture; }},
    {"normal_map", "tangent", [](State& s) { s.normal_map = pbr::NormalMap::tangent; }},
    {"occlusion_map", "texture", [](State& s) { s.occlusion_map = pbr::OcclusionMap::texture; }},
    {"emissive_map", "texture", [](State& s) { s.emissive_map = pbr::EmissiveMap::texture; }},
    {"texture_placement", "placed", [](State& s) { s.texture_placement = pbr::TexturePlacement::placed; }},
    {"sides", "two", [](State& s) { s.sides = pbr::Sides::two; }},
    {"cutout", "threshold", [](State& s) { s.cutout = pbr::CutoutFeature::threshold; }},
    {"vertex_color", "modulate", [](State& s) { s.vertex_color = pbr::VertexColor::modulate; }},
    {"ambient", "hemisphere", [](State& s) { s.ambient = pbr::AmbientFeature::hemisphere; }},
    {"ambient", "spherical_harmonics",
     [](State& s) { s.ambient = pbr::AmbientFeature::spherical_harmonics; }},
    {"ambient", "image", [](State& s) { s.ambient = pbr::AmbientFeature::image; }},
    {"reflection", "image", [](State& s) { s.reflection = pbr::ReflectionFeature::image; }},
    {"clearcoat", "layer", [](State& s) { s.clearcoat = pbr::Clearcoat::layer; }},
    {"sheen", "charlie", [](State& s) { s.sheen = pbr::Sheen::charlie; }},
    {"anisotropy", "brushed", [](State& s) { s.anisotropy = pbr::Anisotropy::brushed; }},
    {"iridescence", "thin_film", [](State& s) { s.iridescence = pbr::Iridescence::thin_film; }},
    {"fog", "linear", [](State& s) { s.fog = pbr::Fog::linear; }},
    {"fog", "exponential", [](State& s) { s.fog = pbr::Fog::exponential; }},
    {"fog", "exponential_squared", [](State& s) { s.fog = pbr::Fog::exponential_squared; }},
    {"light_range", "windowed", [](State& s) { s.light_range = pbr::LightRange::windowed; }},
    {"directional", "", [](State& s) { ++s.directional; }},
    {"point", "", [](State& s) { ++s.point; }},
    {"spot", "", [](State& s) { ++s.spot; }},
    {"directional_shadows", "", [](State& s) { ++s.directional_shadows; }},
    {"point_shadows", "", [](State& s) { ++s.point_shadows; }},
    {"spot_shadows", "", [](State& s) { ++s.spot_shadows; }},
};

/// What an extension of the material states.
float number_of(const gobo::scene::PhysicalMaterial& material, const char* uniform, std::size_t place = 0) {
    return static_cast<float>(material.of_extensions.at(uniform).at(place));
}

pbr::Material material_block(const gobo::scene::Material& of) {
    const gobo::scene::PhysicalMaterial& from = of.physical;
    pbr::Material block{};
    block.baseColor = glm::vec4(from.base_color);
    if (of.alpha_mode == gobo::scene::AlphaMode::opaque) block.baseColor.a = 1;
    block.emission = glm::vec3(of.emission);
    block.metallic = static_cast<float>(from.metallic);
    block.roughness = static_cast<float>(from.roughness);
    block.dielectric = glm::vec3(from.dielectric);
    block.dielectricEdge = static_cast<float>(from.dielectric_edge);
    block.normalScale = static_cast<float>(from.normal_scale);
    block.occlusionStrength = static_cast<float>(from.occlusion_strength);
    for (std::size_t i = 0; i < 3; ++i)
        block.sheenColor[static_cast<int>(i)] = number_of(from, "Material.sheenColor", i);
    block.sheenRoughness = number_of(from, "Material.sheenRoughness");
    block.anisotropy = number_of(from, "Material.anisotropy");
    block.anisotropyDirection = {number_of(from, "Material.anisotropyDirection", 0),
                                 number_of(from, "Material.anisotropyDirection", 1)};
    block.clearcoat = number_of(from, "Material.clearcoat");
    block.clearcoatRoughness = number_of(from, "Material.clearcoatRoughness");
    return block;
}

}  // namespace

PhysicalDraw physical_draw_of(const gobo::scene::Scene& scene, const gobo::scene::Draw& draw) {
    const gobo::scene::Material& material = material_of(scene, draw);
    PhysicalDraw result;
    result.material = material_block(material);
    result.iridescence.factor = number_of(material.physical, "Iridescence.factor");
    result.iridescence.ior = number_of(material.physical, "Iridescence.ior");
    result.iridescence.thickness = number_of(material.physical, "Iridescence.thickness");
    result.cutout.threshold = static_cast<float>(std::min(material.alpha_cutoff, 1.0));
    result.mirrored = static_cast<float>(overrides_of(scene, draw).reflection.value_or(0));
    result.maps = material.physical.maps;
    for (std::size_t map = 0; map < result.maps.size(); ++map) {
        const gobo::scene::TextureUse use = result.maps[map].value_or(gobo::scene::TextureUse());
        auto& placement = result.placements.maps[map];
        placement.linear = glm::vec4(use.linear);
        placement.offset = glm::vec2(use.offset);
        placement.set = use.set;
    }
    result.is_blended = material.alpha_mode == gobo::scene::AlphaMode::blend;
    return result;
}

bool call_for(const gobo::scene::Effect& effect, State& state) {
    const auto* const found = std::ranges::find_if(kCalls, [&](const Call& call) {
        return call.feature == effect.feature && call.value == effect.value;
    });
    if (found == std::end(kCalls)) return false;
    found->make(state);
    return true;
}

State under(const State& state, const Settings& settings) {
    State result = state;
    if (!settings.directional) result.directional = result.directional_shadows = 0;
    if (!settings.point) result.point = result.point_shadows = 0;
    if (!settings.spot) result.spot = result.spot_shadows = 0;
    if (!settings.fog) result.fog = pbr::Fog::none;
    return result;
}

}  // namespace viewer
