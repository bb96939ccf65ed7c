// Textures as data: how they filter, and that a point with textures can be written down and read back.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/images.hpp"

namespace gobo::evaluate {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

struct WrittenCase {
    const char* name;
    const char* declaration;
    const char* expression;
    TextureContent content;
    const char* samplers;  ///< the section as it is written
};

const WrittenCase kWritten[] = {
    {"one_colour", "sampler2D", "texture(tex, a.xy)", EvenColor{{0.25, 0.5, 0.1, 1}, {}},
     "\"tex\" = [0.25, 0.5, 0.1, 1]\n"},
    {"a_colour_that_changes", "samplerCube", "texture(tex, a.xyz)",
     EvenColor{{1, 2, 3, 1}, {{{0.5, 0, 0, 0}, {0, -0.25, 0, 0}, {0, 0, 1, 0}}}},
     "\"tex.along_x\" = [0.5, 0, 0, 0]\n\"tex.along_y\" = [0, -0.25, 0, 0]\n\"tex.along_z\" = [0, 0, 1, 0]\n"
     "\"tex.color\" = [1, 2, 3, 1]\n"},
    {"depths", "sampler2DArrayShadow",
     "vec4(texture(tex, vec4(0.5, 0.5, 1.0, 0.7)), texture(tex, vec4(0.1, 0.5, 0.0, 0.3)), "
     "vec2(textureSize(tex, 0).xy))",
     DepthTexels{2, 1, 2, {0.25, 0.5, 0.75, 0.5}},
     "\"tex.depths\" = [0.25, 0.5, 0.75, 0.5]\n\"tex.size\" = [2, 1, 2]\n"},
    {"one_depth", "sampler2DShadow", "vec4(texture(tex, vec3(0.5, 0.5, 0.4)), a.xyz)",
     EvenColor{{0.5, 0.5, 0.5, 0.5}, {}}, "\"tex\" = [0.5, 0.5, 0.5, 0.5]\n"},
};

class WrittenTexture : public ::testing::TestWithParam<WrittenCase> {};

TEST_P(WrittenTexture, ReadsBackTheSame) {
    const WrittenCase& row = GetParam();
    const Program program = fragment_of(std::string("r = ") + row.expression + ";",
                                        std::string("uniform ") + row.declaration + " tex;\n");
    Invocations invocations;
    invocations.values["a"] = {0.3, -0.2, 0.9, 1};
    invocations.images["tex"] = image_of(row.content, program.images.front().type);
    const EvalPoint point = point_of(program, invocations, 0);
    const std::string file = eval_file("fragment", point, {"a point"}, Digits::all);
    EXPECT_EQ(file, std::string("# a point\nstage = \"fragment\"\n\n[inputs]\n\"a\" = [0.3, -0.2, 0.9, 1]\n"
                                "\n[samplers]\n") +
                        row.samplers);
    const Result<EvalInputs> inputs = read_eval_inputs(file, "point.toml");
    ASSERT_TRUE(inputs) << to_text(inputs.error().front());
    const Result<Invocations> again = invocations_of(*inputs, program);
    ASSERT_TRUE(again) << to_text(again.error().front());
    EXPECT_EQ(run<double>(program, *again)->values.at("r"),
              run<double>(program, invocations)->values.at("r"));
}

INSTANTIATE_TEST_SUITE_P(Textures, WrittenTexture, ::testing::ValuesIn(kWritten),
                         [](const auto& one) { return std::string(one.param.name); });

ImageRequest at(double x, double y, double z = 0) {
    ImageRequest request;
    request.coordinates = {x, y, z, 0};
    return request;
}

TEST(ColorTexels, BlendFourAndRepeat) {
    const ColorTexels texels{2, 2, {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}}};
    using Color = std::array<double, 4>;
    EXPECT_EQ(answer(texels, at(0.25, 0.25)), (Color{0, 0, 0, 1})) << "the centre of a texel";
    EXPECT_EQ(answer(texels, at(0.375, 0.25)), (Color{0.25, 0, 0, 1})) << "a quarter of the way";
    EXPECT_EQ(answer(texels, at(0.5, 0.5)), (Color{0.5, 0.5, 0, 1}));
    EXPECT_EQ(answer(texels, at(0, 0.25)), (Color{0.5, 0, 0, 1})) << "between the last texel and the first";
    EXPECT_EQ(answer(texels, at(-1.625, 3.25)), (Color{0.25, 0, 0, 1})) << "repeated";
}

/// Each texel holds the direction of its centre.
CubeTexels directions(int side) {
    CubeTexels texels;
    texels.side = side;
    constexpr double kAxes[6][3][3] = {
        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
        {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
    for (const auto& face : kAxes)
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const double s = 2 * (column + 0.5) / side - 1;
                const double t = 2 * (row + 0.5) / side - 1;
                const double length = std::sqrt(1 + s * s + t * t);
                std::array<float, 4>& color = texels.colors.emplace_back();
                for (std::size_t i = 0; i < 3; ++i)
                    color[i] = static_cast<float>((face[0][i] + s * face[1][i] + t * face[2][i]) / length);
            }
    return texels;
}

/// On every face, across every edge and into every corner: what is smooth stays smooth. A texel of 16 is an
/// eighth wide, so that a chord lies 1/512 below its arc, and in a corner the mean of three stands for a
/// fourth.
TEST(CubeTexels, AreSmoothAcrossEdges) {
    const CubeTexels texels = directions(16);
    double furthest = 0;
    for (int i = 0; i < 4000; ++i) {
        const double height = -1 + (i + 0.5) / 2000;
        const double turn = 2.39996322972865332 * i;  // the golden angle: evenly over the sphere
        const double radius = std::sqrt(1 - height * height);
        const std::array<double, 3> to = {radius * std::cos(turn), radius * std::sin(turn), height};
        const std::array<double, 4> found = answer(texels, at(to[0], to[1], to[2]));
        for (std::size_t axis = 0; axis < 3; ++axis)
            furthest = std::max(furthest, std::abs(found[axis] - to[axis]));
    }
    EXPECT_LT(furthest, 0.04);
    EXPECT_GT(furthest, 0.001) << "texels were blended";
}

/// Where a place is no number the color is none, and no texel beyond the last is read. The sizes are odd.
TEST(Texels, OfNoNumberAreNoNumber) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const ColorTexels flat{3, 1, {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}};
    const CubeTexels cube = directions(3);
    const DepthTexels depths{3, 1, 1, {0.25F, 0.5F, 0.75F}};
    ImageRequest fetch = at(kNan, kNan);
    fetch.what = ImageRequest::What::fetch;
    EXPECT_EQ(answer(flat, fetch)[0], 1) << "the first";
    for (const double place : {kNan, kInfinity, -kInfinity}) {
        EXPECT_TRUE(std::isnan(answer(flat, at(place, 0.5))[0])) << place;
        EXPECT_TRUE(std::isnan(answer(cube, at(place, 0.5, 0.5))[1])) << place;
        ImageRequest compared = at(place, 0.5);
        compared.compares = true;
        EXPECT_TRUE(std::isnan(answer(depths, compared)[0])) << place;
    }
}

}  // namespace
}  // namespace gobo::evaluate
