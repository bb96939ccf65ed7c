// glTF's factors on their way into a header of the family `pbr`, which is made for the README's still life.
#include <gobo/metallic_roughness.hpp>
#include <gtest/gtest.h>

#include "pbr.hpp"

namespace gobo {
namespace {

TEST(MetallicRoughness, FillsTheBlockAsGltfHasIt) {
    EXPECT_FLOAT_EQ(fill_material<pbr::Material>({}).dielectric.x, 0.04F);
    MetallicRoughness material;
    material.ior = 2;
    material.specular_factor = 0.5F;
    material.specular_color_factor = glm::vec3(1, 20, 1);
    material.emissive_factor = glm::vec3(0.5F);
    material.emissive_strength = 4;
    material.anisotropy_strength = 0.25F;
    const auto block = fill_material<pbr::Material>(material);
    EXPECT_FLOAT_EQ(block.dielectric.x, 0.5F / 9);
    EXPECT_FLOAT_EQ(block.dielectric.y, 0.5F);  // no more than 1 before the weight
    EXPECT_FLOAT_EQ(block.dielectricEdge, 0.5F);
    EXPECT_FLOAT_EQ(block.emission.x, 2);
    EXPECT_FLOAT_EQ(block.anisotropy, 0.25F);
    EXPECT_TRUE(pbr::check(block).empty());
    material.ior = 0;
    material.specular_factor = 1;
    EXPECT_FLOAT_EQ(fill_material<pbr::Material>(material).dielectric.x, 1);
}

TEST(MetallicRoughness, SelectsWhatTheMaterialCallsFor) {
    pbr::Key key;
    key.point = 2;
    MetallicRoughness material;
    material.has_base_color_texture = true;
    material.has_emissive_texture = true;  // of no emission
    material.has_normal_texture = true;
    material.clearcoat_factor = 1;
    const pbr::Key selected = select(material, key);
    EXPECT_EQ(pbr::key_text(selected), "base_color_map=texture clearcoat=layer normal_map=tangent point=2");
    material.is_unlit = true;
    EXPECT_EQ(pbr::key_text(select(material, selected)), "base_color_map=texture lighting=base_color");
}

TEST(MetallicRoughness, TakesSheenAndThinFilms) {
    struct Film {
        float factor, ior, thickness;
    };
    pbr::Key key;
    key.point = 1;
    MetallicRoughness soap;
    soap.sheen_color_factor = glm::vec3(0, 0.5F, 0);
    soap.sheen_roughness_factor = 0.25F;
    soap.iridescence_factor = 0.75F;
    EXPECT_EQ(pbr::key_text(select(soap, key)), "iridescence=thin_film point=1 sheen=charlie");
    const auto block = fill_material<pbr::Material>(soap);
    EXPECT_FLOAT_EQ(block.sheenColor.y, 0.5F);
    EXPECT_FLOAT_EQ(block.sheenRoughness, 0.25F);
    const auto film = fill_iridescence<Film>(soap);
    EXPECT_FLOAT_EQ(film.factor, 0.75F);
    EXPECT_FLOAT_EQ(film.ior, 1.3F);
    EXPECT_FLOAT_EQ(film.thickness, 400);
    soap.is_unlit = true;
    EXPECT_EQ(pbr::key_text(select(soap, key)), "lighting=base_color");
}

TEST(MetallicRoughness, FindsThePermutationsThatASceneNeeded) {
    pbr::Key around;
    around.ambient = pbr::AmbientFeature::image;
    around.reflection = pbr::ReflectionFeature::image;
    around.point = around.spot = around.spot_shadows = 1;
    EXPECT_NE(pbr::find(select({}, around)), nullptr);  // gold
    MetallicRoughness lacquer;
    lacquer.clearcoat_factor = 1;
    around.fog = pbr::Fog::linear;
    EXPECT_NE(pbr::find(select(lacquer, around)), nullptr);
    lacquer.has_emissive_texture = true;
    lacquer.emissive_factor = glm::vec3(1);
    EXPECT_EQ(pbr::find(select(lacquer, around)), nullptr);
}

/// What an application of its own knows of a draw.
struct Draw {
    int mesh = 7;
    int point = 1;
    int spot = 1;
    int spot_shadows = 1;
    pbr::AmbientFeature ambient = pbr::AmbientFeature::image;
    pbr::ReflectionFeature reflection = pbr::ReflectionFeature::image;
};

TEST(MetallicRoughness, StandsBesideTheHeadersOwnSelect) {
    const pbr::Key key = pbr::select(Draw{});
    EXPECT_NE(pbr::find(key), nullptr) << pbr::key_text(key);
    MetallicRoughness material;
    material.anisotropy_strength = 1;
    EXPECT_EQ(select(material, key).anisotropy, pbr::Anisotropy::brushed);
}

}  // namespace
}  // namespace gobo
