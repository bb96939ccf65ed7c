// A renderer draws the same by the ubershader as by the permutation that was made for it, shadows and all.
#include <gtest/gtest.h>

#include "../unit/image_comparison.hpp"
#include "family/key.hpp"
#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "scene_library.hpp"
#include "uber_values.hpp"

namespace gobo::scene {
namespace {

/// A permutation, ready to be drawn.
struct Drawable {
    std::vector<StageText> stages;
    Interface interface;
};

Drawable drawable(const ShippedFamily& shipped, const Key& key) {
    auto shaders = shaders_of(shipped.family, shipped.search, std::vector<Draw>(1), {key}, Dialect::own, 1);
    EXPECT_TRUE(shaders) << to_text(shaders.error());
    const Permutation& permutation = shaders->composition.permutations.front();
    return {{stage_text(shaders->composition, permutation.stages[StageKind::vertex]),
             stage_text(shaders->composition, permutation.stages[StageKind::fragment])},
            shaders->interfaces.front()};
}

DepthPass depth_pass() {
    const ShippedFamily depth("depth");
    const Drawable drawn = drawable(depth, default_key(depth.family));
    DepthPass pass;
    pass.stages = drawn.stages;
    pass.interface = drawn.interface;
    pass.values = depth.family.render;
    pass.side = 128;
    return pass;
}

constexpr const char* keys[] = {
    "directional=2 directional_shadows=1 fog=linear point=2 point_shadows=1 spot=2 spot_shadows=1 "
    "specular=blinn",
    "diffuse=toon_thresholds directional=1 material=array point=1 sides=two vertex_color=modulate",
    "ambient=hemisphere cutout=threshold directional_or_point=4 fog=exponential light_ambient=each "
    "specular=phong",
    "ambient=image diffuse=toon directional=1 directional_shadows=1 material=array reflection=image "
    "sides=two_materials",
    "ambient=spherical_harmonics diffuse=toon_ceil fog=exponential_squared light_ambient=each spot=1",
    "fog=linear lighting=unlit vertex_color=modulate",
};

class UberDrawn : public testing::TestWithParam<UberLights> {};

/// 1e-6: what the driver contracts or reorders in one program and not in the other, eight roundings of the
/// brightest radiance.
TEST_P(UberDrawn, LooksLikeThePermutation) {
    const ShippedFamily lit("lit");
    const ShippedFamily uber("uber");
    const Context context = open_context(Backend::osmesa).value();
    const DepthPass pass = depth_pass();
    const std::vector<Object> objects = demo_objects(make_torus(1, 0.4, 48, 24));
    View view;
    view.camera = demo_camera();
    view.width = 96;
    view.height = 72;
    for (const char* text : keys) {
        SCOPED_TRACE(text);
        const Key key = parse_key(lit.family, text).value();
        std::vector<RenderValue> values = lit.family.render;
        GivenTextures textures;
        const auto lights = shadow_lights(lit.family, key);
        std::optional<ShadowMaps> maps;
        if (!lights.empty()) {
            maps.emplace(draw_shadow_maps(context, pass, lights, objects, view.camera.view()).value());
            textures["shadowMaps"] = maps->texture();
            values.insert(values.end(), maps->values().begin(), maps->values().end());
        }
        const auto draw = [&](const Drawable& drawn, const std::vector<RenderValue>& given) {
            return render_permutation(context, drawn.stages, drawn.interface, objects, given, view, textures)
                .value()
                .color;
        };
        const Image expected = draw(drawable(lit, key), values);
        const Image actual = draw(drawable(uber, uber_key(uber.family, lit.family, key, GetParam())),
                                  uber_values(uber.family, lit.family, key, values));
        const auto difference = compare(actual, expected);
        ASSERT_TRUE(difference);
        EXPECT_LE(difference->largest, 1e-6) << to_text(*difference);
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, UberDrawn, testing::Values(UberLights::switched, UberLights::looped),
                         [](const auto& row) {
                             return row.param == UberLights::switched ? "switched" : "looped";
                         });

}  // namespace
}  // namespace gobo::scene
