// Shadow maps made without a renderer, for the scenes of studies.
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/study/plan.hpp"

namespace gobo::study {
namespace {

/// A family with the features and the light that shadows are made for.
const Family& shadowed_family() {
    static const Family family = read_family(R"(
name = "shadowed"
vertex = "shadowed.vert"
fragment = "shadowed.frag"
[features.directional_shadows]
count = [0, 4]
constant = "DIRECTIONAL_SHADOWS"
[render]
"DirectionalLights.lights[0].direction" = { source = "eye_direction", numbers = [0, 0, 1] }
)",
                                             "shadowed.toml")
                                     .value();
    return family;
}

Key key_of(const std::string& text) {
    return parse_key(shadowed_family(), text).value();
}

/// A square of side 2 in the plane z = 0, lit along -z.
DrawnScene square_scene() {
    DrawnScene scene;
    Object square;
    square.mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.mesh.indices = {0, 1, 2, 0, 2, 3};
    Object behind = square;  // a unit further from the light
    behind.model[3] = {0, 0, -1, 1};
    behind.casts_shadow = false;
    scene.objects = {square, behind};
    scene.values = shadowed_family().render;
    return scene;
}

TEST(SceneShadows, AreNoneWhereNoLightCastsAny) {
    const DrawnScene scene = with_shadows(shadowed_family(), key_of("default"), square_scene());
    EXPECT_EQ(scene.shadow_maps, nullptr);
    EXPECT_EQ(scene.values.size(), square_scene().values.size());
}

TEST(SceneShadows, HoldTheDepthOfWhatIsNearest) {
    const DrawnScene scene = with_shadows(shadowed_family(), key_of("directional_shadows=1"), square_scene());
    ASSERT_NE(scene.shadow_maps, nullptr);
    EXPECT_EQ(scene.shadow_maps->layers, 1);
    EXPECT_GT(scene.values.size(), square_scene().values.size()) << "the block Shadows";
    evaluate::ImageRequest request;
    request.arrayed = request.compares = true;
    request.coordinates = {0.5, 0.5, 0, 0};
    const std::size_t middle = std::size_t{kShadowSide} * (kShadowSide / 2) + kShadowSide / 2;
    const double depth = scene.shadow_maps->depths[middle];
    ASSERT_LT(depth, 1);
    std::vector<std::size_t> near;
    const evaluate::Image image =
        image_of(scene.shadow_maps, [&](std::size_t invocation) { near.push_back(invocation); });
    struct Row {
        double reference;
        double lit;
        bool is_near;
    };
    for (const auto& [reference, lit, is_near] : {Row{depth - 0.01, 1, false}, Row{depth - 1e-6, 1, true},
                                                  Row{depth + 1e-6, 0, true}, Row{depth + 0.01, 0, false}}) {
        near.clear();
        request.reference = reference;
        request.invocation = 7;
        EXPECT_EQ(image(request)[0], lit) << reference - depth;
        EXPECT_EQ(near, is_near ? std::vector<std::size_t>{7} : std::vector<std::size_t>{})
            << reference - depth;
    }
}

}  // namespace
}  // namespace gobo::study
