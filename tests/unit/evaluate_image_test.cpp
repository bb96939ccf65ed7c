// Quads and their derivatives; texture functions, which ask the caller's images.
#include <array>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

using ::testing::ElementsAre;

/// Two quads whose input a.x is p(x, y), at (0, 0) and (10, 20).
Invocations two_quads(const std::function<double(double x, double y)>& p) {
    Invocations invocations;
    invocations.count = 8;
    invocations.values["a"].assign(32, 0.0);
    for (std::size_t i = 0; i < 8; ++i) {
        const double x = static_cast<double>(i % 2) + (i < 4 ? 0 : 10);
        const double y = static_cast<double>(i / 2 % 2) + (i < 4 ? 0 : 20);
        invocations.values["a"][i] = p(x, y);
    }
    return invocations;
}

struct DerivativeCase {
    const char* name;
    const char* expression;
    std::array<double, 8> expected;  ///< for a.x = x * y + 3 x
};

const DerivativeCase kDerivatives[] = {
    {"dFdx", "dFdx(a.x)", {3, 3, 4, 4, 23, 23, 24, 24}},
    {"dFdy", "dFdy(a.x)", {0, 1, 0, 1, 10, 11, 10, 11}},
    {"fwidth", "fwidth(-a.x)", {3, 4, 4, 5, 33, 34, 34, 35}},
    {"dFdxFine", "dFdxFine(a.x)", {3, 3, 4, 4, 23, 23, 24, 24}},
    {"dFdyFine", "dFdyFine(a.x)", {0, 1, 0, 1, 10, 11, 10, 11}},
    {"fwidthFine", "fwidthFine(a.x)", {3, 4, 4, 5, 33, 34, 34, 35}},
    {"dFdxCoarse", "dFdxCoarse(a.x)", {3, 3, 3, 3, 23, 23, 23, 23}},
    {"dFdyCoarse", "dFdyCoarse(a.x)", {0, 0, 0, 0, 10, 10, 10, 10}},
    {"fwidthCoarse", "fwidthCoarse(a.x)", {3, 3, 3, 3, 33, 33, 33, 33}},
    {"interpolateAtCentroid", "interpolateAtCentroid(a).x", {0, 3, 0, 4, 230, 253, 240, 264}},
    {"interpolateAtSample", "interpolateAtSample(a, 0).x", {0, 3, 0, 4, 230, 253, 240, 264}},
    {"interpolateAtOffset",
     "interpolateAtOffset(a, vec2(0.5, 0.25)).x",
     {1.5, 4.75, 2, 6.25, 244, 267.25, 254.5, 278.75}},
};

class Derivatives : public ::testing::TestWithParam<DerivativeCase> {};

TEST_P(Derivatives, AreDifferencesInTheQuad) {
    const Program program = fragment_of(std::string("r = vec4(") + GetParam().expression + ");");
    const Result<Outputs> outputs =
        run<float>(program, two_quads([](double x, double y) { return x * y + 3 * x; }));
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    // Small multiples of 1/4: exact.
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(outputs->values.at("r")[i], GetParam().expected[i]) << i;
}

INSTANTIATE_TEST_SUITE_P(Functions, Derivatives, ::testing::ValuesIn(kDerivatives),
                         [](const auto& one) { return std::string(one.param.name); });

struct ImageCase {
    const char* name;
    const char* declaration;
    const char* expression;  ///< with i = 2 and a = (0.25, 0.5, 0.75, 2)
    std::function<std::array<double, 4>(const ImageRequest&)> image;  ///< checks, and answers
    std::vector<double> expected;
};

using What = ImageRequest::What;
using Answer = std::array<double, 4>;

const ImageCase kImages[] = {
    {"sample",
     "sampler2D",
     "texture(tex, a.xy)",
     [](const ImageRequest& q) {
         EXPECT_FALSE(q.has_lod);
         EXPECT_EQ(q.dimensions, 2);
         return Answer{q.coordinates[0], q.coordinates[1], 3, 4};
     },
     {0.25, 0.5, 3, 4}},
    {"bias",
     "sampler2D",
     "texture(tex, a.xy, 1.5)",
     [](const ImageRequest& q) { return Answer{q.bias}; },
     {1.5, 0, 0, 0}},
    {"lod",
     "samplerCube",
     "textureLod(tex, a.xyz, 2.0)",
     [](const ImageRequest& q) {
         EXPECT_EQ(q.dimensions, 3);
         return Answer{q.coordinates[2], q.lod, q.has_lod ? 1.0 : 0.0};
     },
     {0.75, 2, 1, 0}},
    {"gradient",
     "sampler2D",
     "textureGrad(tex, a.xy, a.zw, a.yx)",
     [](const ImageRequest& q) {
         return Answer{q.dx[0], q.dx[1], q.dy[0], q.dy[1]};
     },
     {0.75, 2, 0.5, 0.25}},
    {"offset",
     "sampler2D",
     "textureLodOffset(tex, a.xy, 0.0, ivec2(3, -4))",
     [](const ImageRequest& q) {
         return Answer{static_cast<double>(q.offset[0]), static_cast<double>(q.offset[1])};
     },
     {3, -4, 0, 0}},
    {"projected",
     "sampler2D",
     "textureProj(tex, a)",
     [](const ImageRequest& q) {
         return Answer{q.coordinates[0], q.coordinates[1]};
     },
     {0.125, 0.25, 0, 0}},
    {"layer",
     "sampler2DArray",
     "texture(tex, a.xyw)",
     [](const ImageRequest& q) {
         EXPECT_TRUE(q.arrayed);
         EXPECT_EQ(q.dimensions, 2);
         return Answer{q.coordinates[2]};
     },
     {2, 0, 0, 0}},
    {"shadow",
     "sampler2DShadow",
     "vec4(texture(tex, a.xyz))",
     [](const ImageRequest& q) {
         EXPECT_TRUE(q.compares);
         return Answer{q.reference + q.coordinates[0]};
     },
     {1, 1, 1, 1}},
    {"shadow_of_a_layer",
     "sampler2DArrayShadow",
     "vec4(texture(tex, vec4(a.xy, 1.0, a.z)))",
     [](const ImageRequest& q) { return Answer{q.reference * 100 + q.coordinates[2]}; },
     {76, 76, 76, 76}},
    {"projected_shadow",
     "sampler2DShadow",
     "vec4(textureProj(tex, a))",
     [](const ImageRequest& q) { return Answer{q.reference}; },
     {0.375, 0.375, 0.375, 0.375}},
    {"fetch",
     "sampler2D",
     "texelFetch(tex, ivec2(i, i + 1), 3)",
     [](const ImageRequest& q) {
         EXPECT_EQ(q.what, What::fetch);
         return Answer{q.coordinates[0], q.coordinates[1], q.lod};
     },
     {2, 3, 3, 0}},
    {"gather",
     "sampler2D",
     "textureGather(tex, a.xy, 2)",
     [](const ImageRequest& q) {
         EXPECT_EQ(q.what, What::gather);
         return Answer{static_cast<double>(q.component), 1, 2, 3};
     },
     {2, 1, 2, 3}},
    {"size",
     "sampler2D",
     "vec4(textureSize(tex, i), 0.0, 0.0)",
     [](const ImageRequest& q) {
         EXPECT_EQ(q.what, What::size);
         return Answer{64 / (q.lod + 2), 32};
     },
     {16, 32, 0, 0}},
    {"levels",
     "sampler2D",
     "vec4(textureQueryLevels(tex))",
     [](const ImageRequest& q) {
         EXPECT_EQ(q.what, What::levels);
         return Answer{7};
     },
     {7, 7, 7, 7}},
    {"level_of_detail",
     "sampler2D",
     "vec4(textureQueryLod(tex, a.xy), 0.0, 0.0)",
     [](const ImageRequest& q) {
         EXPECT_EQ(q.what, What::lod);
         return Answer{1, 1.5};
     },
     {1, 1.5, 0, 0}},
    {"integers",
     "isampler2D",
     "vec4(texture(tex, a.xy))",
     [](const ImageRequest&) {
         return Answer{-5, 6};
     },
     {-5, 6, 0, 0}},
    {"array_of_samplers",
     "sampler2D",
     "texture(texs[i], a.xy)",
     [](const ImageRequest&) { return Answer{1}; },
     {102, 0, 0, 0}},
};

class TextureFunctions : public ::testing::TestWithParam<ImageCase> {};

TEST_P(TextureFunctions, AreAskedForWhatTheShaderSays) {
    const Program program = fragment_of(
        std::string("r = ") + GetParam().expression + ";",
        std::string("layout(binding = 0) uniform ") + GetParam().declaration +
            " tex;\nlayout(binding = 1) uniform sampler2D texs[3];\nlayout(location = 5) flat in int i;\n");
    Invocations invocations;
    invocations.values = {{"a", {0.25, 0.5, 0.75, 2}}, {"i", {2}}};
    invocations.images["tex"] = GetParam().image;
    invocations.images["texs[2]"] = [](const ImageRequest&) { return Answer{102}; };
    const Result<Outputs> in_float = run<float>(program, invocations);
    ASSERT_TRUE(in_float) << to_text(in_float.error().front());
    EXPECT_EQ(in_float->values.at("r"), GetParam().expected);  // short binary fractions: exact
    const Result<Outputs> in_double = run<double>(program, invocations);
    ASSERT_TRUE(in_double);
    EXPECT_EQ(in_double->values.at("r"), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Functions, TextureFunctions, ::testing::ValuesIn(kImages),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(ImageQuads, ImplicitGradientsComeFromTheQuad) {
    const Program program =
        fragment_of("r = texture(tex, a.xx);", "layout(binding = 0) uniform sampler2D tex;");
    Invocations invocations = two_quads([](double x, double y) { return 0.25 * x + 0.5 * y; });
    invocations.images["tex"] = [](const ImageRequest& q) {
        return Answer{q.dx[0], q.dy[1], static_cast<double>(q.invocation)};
    };
    const Result<Outputs> outputs = run<float>(program, invocations);
    ASSERT_TRUE(outputs);
    const std::vector<double>& r = outputs->values.at("r");
    EXPECT_THAT(
        std::vector<double>(r.begin(), r.begin() + 16),
        ElementsAre(0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5));
    EXPECT_THAT(std::vector<double>(r.begin() + 16, r.begin() + 24), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(ImageQuads, HelpersAskNoImage) {
    const Program program =
        fragment_of("r = texture(tex, a.xy);", "layout(binding = 0) uniform sampler2D tex;");
    Invocations invocations = two_quads([](double x, double) { return x; });
    invocations.helpers = {false, true, true, true, false, true, true, true};
    int asked = 0;
    invocations.images["tex"] = [&](const ImageRequest&) {
        ++asked;
        return Answer{};
    };
    ASSERT_TRUE(run<float>(program, invocations));
    EXPECT_EQ(asked, 2);
}

TEST(ImageErrors, AMissingImageIsNamed) {
    const Program program =
        fragment_of("r = texture(tex, a.xy);", "layout(binding = 0) uniform sampler2D tex;");
    const Result<Outputs> outputs = run<float>(program, {});
    ASSERT_FALSE(outputs);
    EXPECT_EQ(to_text(outputs.error().front()),
              "gobo: error: the stage reads the sampler 'tex', for which no image is given\n");
}

}  // namespace
}  // namespace gobo::evaluate
