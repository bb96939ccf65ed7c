// Scenes drawn by OpenGL and by the evaluator are the same picture.
#include <gtest/gtest.h>

#include "../unit/scene_support.hpp"
#include "lab/render/image.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "scene_library.hpp"
#include "software_scene.hpp"

namespace gobo::scene {
namespace {

constexpr int width = 80;
constexpr int height = 60;
constexpr int map_side = 256;

struct Row {
    const char* name;
    const char* file;
    const char* buckets;
    /// Pixels of 4800 in which triangles' edges, holes' rims or shadows' outlines may fall to either side.
    int different = 48;
};

class Scenes : public testing::TestWithParam<Row> {};

Image drawn(const Scene& scene, const SceneShaders& shaders, const Family& family, const SceneView& view) {
    const auto context = open_context(Backend::osmesa);
    EXPECT_TRUE(context) << to_text(context.error());
    const DepthPass depth_pass = shipped_depth_pass(map_side);
    const auto picture = draw_scene(*context, scene, shaders, family.render, view, {&depth_pass, {}});
    EXPECT_TRUE(picture) << to_text(picture.error());
    EXPECT_EQ(to_text(picture->warnings), "");
    return picture->color;
}

SoftwarePicture evaluated(const Scene& scene, const SceneShaders& shaders, const Family& family,
                          const SceneView& view) {
    const auto programs = software_programs(shaders);
    EXPECT_TRUE(programs) << to_text(programs.error());
    const std::vector<Object> objects = objects_of(scene, shaders);
    auto picture =
        draw_in_software(shaders, *programs, objects, values_beside_scene(family.render), view, false,
                         software_images(images_of(scene, shaders.draws), objects, map_side));
    EXPECT_TRUE(picture) << to_text(picture.error());
    return std::move(*picture);
}

/// Whether a pixel and its neighbours show one draw: not at an outline, which a rounding may move.
bool is_inside(const std::vector<int>& draw, int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int column = std::clamp(x + dx, 0, width - 1);
            const int row = std::clamp(y + dy, 0, height - 1);
            if (draw[static_cast<std::size_t>(row * width + column)] !=
                draw[static_cast<std::size_t>(y * width + x)])
                return false;
        }
    return true;
}

/// llvmpipe interpolates a normal to 4e-6 at this size; what is computed from it follows, times the shininess
/// of at most 90. At the edges of triangles within a draw either triangle may be hit: one pixel in a hundred
/// is allowed to be off by what a crease of the teapot shows.
TEST_P(Scenes, LookTheSameDrawnAndEvaluated) {
    const ShippedFamily lit("lit");
    const Scene scene = shipped_scene(GetParam().file);
    const auto buckets = parse_buckets(GetParam().buckets);
    const auto shaders =
        shaders_for_draws(lit.family, lit.search, required_effects(scene, eye_of_cameras(scene), {}),
                          *buckets, Dialect::own, 1);
    ASSERT_TRUE(shaders) << to_text(shaders.error());
    const auto view = view_of_camera(scene, 0, width, height);
    ASSERT_TRUE(view);
    const Image picture = drawn(scene, *shaders, lit.family, *view);
    const SoftwarePicture expected = evaluated(scene, *shaders, lit.family, *view);
    int seen = 0;
    int different = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (!is_inside(expected.draw, x, y)) continue;
            if (expected.draw[static_cast<std::size_t>(y * width + x)] >= 0) ++seen;
            for (int c = 0; c < 4; ++c) {
                const float limit = 5e-4F * (1 + std::abs(expected.color.at(x, y, c)));
                if (std::abs(picture.at(x, y, c) - expected.color.at(x, y, c)) <= limit) continue;
                ++different;
                break;
            }
        }
    }
    EXPECT_GT(seen, width * height / 10);
    EXPECT_LE(different, GetParam().different);
}

constexpr Row rows[] = {
    {"the_teapot", "teapot.gltf", ""},
    {"the_teapot_with_lights_to_spare", "teapot.gltf", "0,4"},
    {"colours_of_vertices", "made/vertex_colors.gltf", ""},
    {"holes_by_colours_of_vertices", "made/perforated.gltf", ""},
    {"holes_by_a_picture", "made/leaves.gltf", ""},
    {"instances", "made/gpu_instances.gltf", ""},
    {"morphed_normals", "made/morphed_normals.gltf", ""},
    {"a_sky", "made/open_sky.gltf", ""},
    {"a_probe", "made/harmonics.gltf", ""},
    {"the_suns_shadow", "made/sun_shadow.gltf", ""},
    {"shadows_of_lamps", "made/lamp_shadows.gltf", ""},
};

INSTANTIATE_TEST_SUITE_P(Renderer, Scenes, testing::ValuesIn(rows),
                         [](const auto& row) { return row.param.name; });

/// A permutation for more lights than are there draws the same to the bit: the others are black.
TEST(Scenes, WithLightsToSpareAreTheSameToTheBit) {
    const ShippedFamily lit("lit");
    const Scene scene = shipped_scene("teapot.gltf");
    const auto view = view_of_camera(scene, 0, width, height);
    std::vector<Image> pictures;
    for (const char* buckets : {"", "0,4"}) {
        const auto shaders =
            shaders_for_draws(lit.family, lit.search, required_effects(scene, eye_of_cameras(scene), {}),
                              *parse_buckets(buckets), Dialect::own, 1);
        ASSERT_TRUE(shaders) << to_text(shaders.error());
        pictures.push_back(evaluated(scene, *shaders, lit.family, *view).color);
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

TEST(SceneViews, AreOfTheCamerasThatNodesHold) {
    const Scene scene = shipped_scene("teapot.gltf");
    EXPECT_EQ(first_camera(scene), 0U);
    EXPECT_TRUE(view_of_camera(scene, 0, 4, 3));
    EXPECT_FALSE(view_of_camera(scene, 1, 4, 3));
}

TEST(SceneViews, TellWhetherAllFacesAreTurnedAway) {
    const Scene teapot = shipped_scene("teapot.gltf");
    const Scene quad = read_patched("[]");
    const Scene mirrored = read_patched(R"([{"op": "add", "path": "/nodes/0/scale", "value": [-1, 1, 1]}])");
    const Scene two_sided =
        read_patched(R"([{"op": "add", "path": "/materials/0/doubleSided", "value": true}])");
    struct Seen {
        const char* name;
        const Scene& scene;
        double z;  ///< of the direction to the viewer
        bool are_away;
    };
    const Seen seen[] = {{"a closed mesh", teapot, -1, false},
                         {"the quad's front", quad, 1, false},
                         {"its back", quad, -1, true},
                         {"mirrored, its front", mirrored, 1, false},
                         {"mirrored, its back", mirrored, -1, true},
                         {"both sides", two_sided, -1, false}};
    for (const Seen& row : seen) {
        const auto draws = required_effects(row.scene, {}, {});
        const SceneView view = view_of_all(draws, glm::dvec3(0.1, 0.2, row.z), 40, 30);
        EXPECT_EQ(turns_all_faces_away(row.scene, draws, view), row.are_away) << row.name;
    }
}

TEST(SceneViews, OfEverythingHoldAllBounds) {
    const Scene scene = shipped_scene("teapot.gltf");
    const auto draws = required_effects(scene, eye_of_cameras(scene), {});
    for (const glm::dvec3 direction : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0.2, -3), glm::dvec3(-1, 0, 0)}) {
        const SceneView view = view_of_all(draws, direction, 30, 90);
        for (const Draw& draw : draws) {
            for (int i = 0; i < 8; ++i) {
                const glm::dvec4 clip = view.projection * view.view * glm::dvec4(draw.bounds->corner(i), 1);
                EXPECT_LE(std::abs(clip.x), clip.w);
                EXPECT_LE(std::abs(clip.y), clip.w);
                EXPECT_LE(std::abs(clip.z), clip.w);
            }
        }
    }
}

}  // namespace
}  // namespace gobo::scene
