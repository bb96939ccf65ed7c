// That shadow maps are cross-checked: texel by texel those that are right pass, and those that are not do
// not.
#include "lab/verify/shadow_map_check.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "family/read_family.hpp"
#include "lab/render/render.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

verify::ShadowPass shadow_pass() {
    const std::string path = std::string(GOBO_SOURCE_DIR) + "/templates/depth.toml";
    const Family family = read_family(DiskFileSystem().read(path).value(), path).value();
    const Composition composition = compose_lit(family, keys_of(family, {"default"}), {}).value();
    ValidateOptions options;
    options.keep_spirv = true;
    const Validated validated = validate(family, composition, options);
    const Permutation& permutation = composition.permutations.front();
    verify::ShadowPass result;
    result.pass.stages = {stage_text(composition, permutation.stages[StageKind::vertex]),
                          stage_text(composition, permutation.stages[StageKind::fragment])};
    result.pass.interface = interface_of(validated, permutation);
    result.pass.values = family.render;
    result.pass.side = 64;
    result.vertex = validated.stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])].spirv;
    result.fragment =
        validated.stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])].spirv;
    return result;
}

/// One light of each kind about the scene.
std::vector<ShadowLight> lights() {
    using Kind = ShadowLight::Kind;
    return {{Kind::directional, glm::dvec3(0), glm::normalize(glm::dvec3(1, 2, 1)), 0},
            {Kind::spot, glm::dvec3(2, 3, 1), glm::normalize(glm::dvec3(-2, -3, -1)), 0.5},
            {Kind::point, glm::dvec3(0.5, 1.5, 2), glm::dvec3(0), 0}};
}

verify::ShadowMapReport compare(const verify::ShadowPass& drawn, const verify::ShadowPass& evaluated) {
    const Context context = open_context(Backend::osmesa).value();
    const std::vector<Object> objects = demo_objects(make_sphere(24, 12));
    const glm::dmat4 view = demo_camera().view();
    const ShadowMaps maps = draw_shadow_maps(context, drawn.pass, lights(), objects, view).value();
    const ShadowPlan plan = shadow_plan(lights(), objects, view, evaluated.pass.side);
    std::vector<Image> layers;
    for (std::size_t i = 0; i < plan.cameras.size(); ++i) layers.push_back(maps.layer(static_cast<int>(i)));
    return verify::compare_shadow_maps(layers, evaluated, plan.cameras, objects);
}

TEST(ShadowMapCheck, PassesWhatAgrees) {
    const verify::ShadowPass pass = shadow_pass();
    const verify::ShadowMapReport report = compare(pass, pass);
    ASSERT_TRUE(report.diagnostics.empty()) << to_text(report.diagnostics.front());
    EXPECT_EQ(report.maps, 8U);
    EXPECT_EQ(report.texels, 8U * 64 * 64);
    EXPECT_EQ(report.wrong, 0U);
    EXPECT_FALSE(report.fails());
    EXPECT_GT(report.largest_ratio, 0) << "floats that agree to the bit were not drawn";
}

TEST(ShadowMapCheck, FindsAnotherOffset) {
    const verify::ShadowPass pass = shadow_pass();
    verify::ShadowPass steeper = pass;
    steeper.pass.slope = 2.1;
    EXPECT_TRUE(compare(steeper, pass).fails());
    verify::ShadowPass further = pass;
    further.pass.units = 400;  // of 2^-24: 24e-6
    EXPECT_TRUE(compare(further, pass).fails());
}

TEST(ShadowMapCheck, FailsForManyEdges) {
    verify::ShadowMapReport report;
    report.texels = 1000;
    report.edges = 10;
    EXPECT_FALSE(report.fails());
    ++report.edges;
    EXPECT_TRUE(report.fails()) << "more than 1 %";
}

}  // namespace
}  // namespace gobo
