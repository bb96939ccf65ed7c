// That the cross-check by the renderer passes what agrees and finds what does not.
#include "lab/verify/cross_check.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "lab/raster/pipeline.hpp"
#include "lab/raster/random.hpp"
#include "lab/render/render.hpp"
#include "lit_library.hpp"
#include "spirv/module.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using raster::PictureReport;

/// A cube map whose every texel is another colour, all mild.
Image patchwork() {
    constexpr int kSide = 8;
    Image faces(kSide, 6 * kSide, 3);
    Random random(5);
    for (float& value : faces.values) value = static_cast<float>(random.between(0.3, 0.5));
    return faces;
}

verify::CrossCheckScene scene_of(const Family& family) {
    verify::CrossCheckScene scene;
    scene.objects = demo_objects(make_sphere(48, 24));
    scene.values = family.render;
    scene.view.camera = demo_camera();
    scene.view.width = scene.view.height = 64;
    for (const char* sampler : {"diffuseMap", "specularMap"}) scene.cubes[sampler] = {patchwork()};
    return scene;
}

/// The renderer draws the library with `overlay`, the evaluator the one as it stands: as if either were
/// wrong.
Result<PictureReport> compare(const std::string& key, const Overlay& overlay) {
    const Family family = lit_family();
    const std::vector<Key> keys = keys_of(family, {key});
    const Result<Composition> drawn = compose_lit(family, keys, overlay);
    if (!drawn) return tl::unexpected(drawn.error());
    const Result<Composition> evaluated = compose_lit(family, keys, {});
    if (!evaluated) return tl::unexpected(evaluated.error());
    ValidateOptions options;
    options.keep_spirv = true;
    const Validated validated = validate(family, *evaluated, options);
    auto report = verify::cross_check("OSMesa", Backend::osmesa, *drawn, validated, scene_of(family), 1);
    if (!report) return tl::unexpected(report.error());
    return std::move(report->pictures.front());
}

struct Disagreement {
    const char* name;
    const char* key;
    const char* piece;
    const char* from;
    const char* to;
};

constexpr Disagreement disagreements[] = {
    {"a product off by a thousandth", "directional=1", "lighting/response.glsl", "vec3 diffuse = tinted",
     "vec3 diffuse = 1.001 * tinted"},
    {"fog by another distance", "fog=linear", "fog_distance/radial.glsl", "vectorLength(surfacePosition())",
     "-surfacePosition().z"},
    {"a normal not normalised", "directional=1", "surface/normal.frag.glsl", "shadingDirection(eyeNormal)",
     "eyeNormal"},
    {"an environment turned the wrong way", "ambient=image", "ambient/image.glsl",
     "imageLight.toMap * visibleNormal()", "visibleNormal() * imageLight.toMap"},
    {"a mirrored ray turned about", "reflection=image", "reflection/image.glsl", "reflect(-viewer, normal)",
     "reflect(viewer, normal)"},
    {"holes of the wrong texels", "cutout=threshold", "cutout/threshold.glsl",
     "texture(opacityMap, surfaceTextureCoordinate())",
     "texture(opacityMap, surfaceTextureCoordinate() + 0.125)"},
    {"depth moved the wrong way", "depth=greater directional=1", "depth/greater.glsl",
     "gl_FragCoord.z + away", "1.0 - gl_FragCoord.z"},
};

TEST(CrossCheck, FindsDisagreements) {
    for (const Disagreement& row : disagreements) {
        std::string text = piece_text(row.piece);
        const auto place = text.find(row.from);
        ASSERT_NE(place, std::string::npos) << row.name;
        text.replace(place, std::string(row.from).size(), row.to);
        const Result<PictureReport> report = compare(row.key, {{row.piece, text}});
        ASSERT_TRUE(report) << row.name << ": " << to_text(report.error().front());
        ASSERT_TRUE(report->diagnostics.empty()) << to_text(report->diagnostics.front());
        EXPECT_TRUE(report->fails()) << row.name;
        EXPECT_GT(report->wrong, 0U) << row.name;
        EXPECT_GT(report->largest_error, raster::kArithmeticError)
            << row.name << ": wrong pixels are measured";
        EXPECT_EQ(report->actual.width, 64) << row.name << ": the pictures are kept";
    }
}

/// llvmpipe takes all as fine ones, so that no picture here shows the other way.
TEST(CrossCheck, KnowsTheWaysInWhichDriversTakeDerivatives) {
    const auto module_of = [](const std::vector<spv::Op>& opcodes) {
        std::vector<std::uint32_t> words = {spv::MagicNumber, 0x10000, 0, 100, 0};
        for (const spv::Op opcode : opcodes)
            words.insert(words.end(), {4U << 16U | static_cast<std::uint32_t>(opcode), 1, 2, spv::OpDPdx});
        return words;
    };
    using enum raster::Derivatives;
    const auto module = module_of({spv::OpDPdx, spv::OpDPdyCoarse, spv::OpFwidth, spv::OpDPdxFine});
    EXPECT_EQ(raster::with_derivatives(module, fine),
              module_of({spv::OpDPdxFine, spv::OpDPdyFine, spv::OpFwidthFine, spv::OpDPdxFine}));
    EXPECT_EQ(raster::with_derivatives(module, coarse),
              module_of({spv::OpDPdxCoarse, spv::OpDPdyCoarse, spv::OpFwidthCoarse, spv::OpDPdxFine}));
}

TEST(CrossCheck, PassesWhatAgreesAndHasSeenTheScene) {
    for (const std::string key :
         {"directional=1 point=1 specular=blinn", "shading=vertex spot=1 specular=phong",
          "depth=any diffuse=toon fog=exponential point=2", "ambient=image reflection=image",
          "cutout=threshold directional=1"}) {
        const Result<PictureReport> report = compare(key, {});
        ASSERT_TRUE(report) << to_text(report.error().front());
        ASSERT_TRUE(report->diagnostics.empty()) << to_text(report->diagnostics.front());
        EXPECT_FALSE(report->fails()) << key;
        EXPECT_GT(report->drawn, report->pixels / 2) << key;
        EXPECT_GT(report->largest_error, 0) << key << ": floats that agree to the bit were not drawn";
    }
}

TEST(CrossCheck, FailsForEdgesAndForManySmallErrors) {
    PictureReport report;
    report.pixels = 1000;
    report.edges = 10;
    report.root_mean_square = raster::kRmsLimit;
    EXPECT_FALSE(report.fails());
    ++report.edges;
    EXPECT_TRUE(report.fails()) << "more than 1 %";
    report.edges = 0;
    report.root_mean_square = std::nextafter(raster::kRmsLimit, 1);
    EXPECT_TRUE(report.fails());
    report.root_mean_square = 0;
    report.wrong = 1;
    EXPECT_TRUE(report.fails());
}

}  // namespace
}  // namespace gobo
