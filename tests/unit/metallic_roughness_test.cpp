// glTF's factors on their way into a header of the family `pbr`, with stand-ins for the header's types.
#include <gobo/metallic_roughness.hpp>
#include <gtest/gtest.h>

namespace gobo {
namespace {

struct Block {
    glm::vec4 baseColor;
    glm::vec3 emission, dielectric;
    float metallic, roughness, dielectricEdge, clearcoat, clearcoatRoughness, anisotropy, normalScale,
        occlusionStrength;
    glm::vec2 anisotropyDirection;
};

enum class Map { none, texture };
struct Key {
    enum class Lighting { metallic_roughness, base_color } lighting{};
    enum class Normal { none, tangent } normal_map{};
    enum class Coat { none, layer } clearcoat{};
    enum class Brush { none, brushed } anisotropy{};
    Map base_color_map{}, metallic_roughness_map{}, occlusion_map{}, emissive_map{};
    int point = 0;
};

TEST(MetallicRoughness, FillsTheBlockAsGltfHasIt) {
    EXPECT_FLOAT_EQ(fill_material<Block>({}).dielectric.x, 0.04F);
    MetallicRoughness material;
    material.ior = 2;
    material.specular_factor = 0.5F;
    material.specular_color_factor = glm::vec3(1, 20, 1);
    material.emissive_factor = glm::vec3(0.5F);
    material.emissive_strength = 4;
    const auto block = fill_material<Block>(material);
    EXPECT_FLOAT_EQ(block.dielectric.x, 0.5F / 9);
    EXPECT_FLOAT_EQ(block.dielectric.y, 0.5F);  // no more than 1 before the weight
    EXPECT_FLOAT_EQ(block.dielectricEdge, 0.5F);
    EXPECT_FLOAT_EQ(block.emission.x, 2);
    material.ior = 0;
    material.specular_factor = 1;
    EXPECT_FLOAT_EQ(fill_material<Block>(material).dielectric.x, 1);
}

TEST(MetallicRoughness, SelectsWhatTheMaterialCallsFor) {
    Key key;
    key.point = 2;
    MetallicRoughness material;
    material.has_base_color_texture = true;
    material.has_emissive_texture = true;  // of no emission
    material.has_normal_texture = true;
    material.clearcoat_factor = 1;
    const Key selected = select(material, key);
    EXPECT_EQ(selected.point, 2);
    EXPECT_EQ(selected.base_color_map, Map::texture);
    EXPECT_EQ(selected.emissive_map, Map::none);
    EXPECT_EQ(selected.normal_map, Key::Normal::tangent);
    EXPECT_EQ(selected.clearcoat, Key::Coat::layer);
    material.is_unlit = true;
    EXPECT_EQ(select(material, key).lighting, Key::Lighting::base_color);
    EXPECT_EQ(select(material, key).normal_map, Key::Normal::none);
    EXPECT_EQ(select(material, selected).clearcoat, Key::Coat::none);
}

}  // namespace
}  // namespace gobo
