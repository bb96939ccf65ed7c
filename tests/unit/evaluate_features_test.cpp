// What lighting families use beside arithmetic: each row is a small shader of the kind that they generate.
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

struct FeatureCase {
    const char* name;
    const char* declarations;
    const char* body;  ///< with a = (0.25, 0.5, 0.75, 2) and k = 3
    std::vector<double> expected;
};

const FeatureCase kCases[] = {
    {"an_array_of_images_by_a_uniform",
     "layout(binding = 0) uniform sampler2D maps[3]; uniform int which;",
     "r = texture(maps[which], a.xy);",
     {2, 0.25, 0.5, 0}},
    {"an_array_of_images_in_a_loop",
     "layout(binding = 0) uniform sampler2D maps[3];",
     "r = vec4(0.0); for (int i = 0; i < 3; ++i) r += texture(maps[i], a.xy);",
     {3, 0.75, 1.5, 0}},
    {"a_shadow_of_a_layer_divided_by_hand",
     "layout(binding = 3) uniform sampler2DArrayShadow shadows;",
     "vec4 q = a * 2.0; r = vec4(q.w > 0.0 ? texture(shadows, vec4(q.xy / q.w, 1.0, q.z / q.w)) : 1.0);",
     {0.375, 0.375, 0.375, 0.375}},
    {"a_point_behind_the_light_looks_nothing_up",
     "layout(binding = 3) uniform sampler2DArrayShadow shadows;",
     "vec4 q = -a; r = vec4(q.w > 0.0 ? texture(shadows, vec4(q.xy / q.w, 1.0, q.z / q.w)) : 1.0);",
     {1, 1, 1, 1}},
    {"cube_maps_at_a_level",
     "layout(binding = 4) uniform samplerCube sky;",
     "r = textureLod(sky, reflect(vec3(0.0, 0.0, -1.0), vec3(0.0, 0.0, 1.0)), a.w);",
     {0, 0, 1, 2}},
    {"a_flat_index_into_a_block",
     "layout(location = 9) flat in int k; layout(std140, binding = 0) uniform Table { "
     "vec4 rows[14]; } table;",
     "r = table.rows[k + 1];",
     {4, 40, 400, 4000}},
    {"a_bit_of_a_mask",
     "layout(location = 9) flat in int k;",
     "r = vec4((k & (1 << 1)) != 0 ? 1.0 : 0.0, (uint(k) >> 1u) & 1u, k % 2, k / 2);",
     {1, 1, 1, 1}},
    {"the_side_that_faces", "", "r = gl_FrontFacing ? a : -a;", {-0.25, -0.5, -0.75, -2}},
    {"an_error_that_folding_would_lose",
     "",
     "precise float s = a.w + 1.0e-8; precise float rest = (s - a.w) - 1.0e-8; r = vec4(rest == -1.0e-8);",
     {1, 1, 1, 1}},
    {"matrices_by_column_and_row",
     "layout(std140, binding = 0) uniform Table { layout(row_major) mat3x4 turn; } "
     "table;",
     "r = table.turn * a.xyz + vec4(transpose(mat3(1.0)) * a.xyz, 0.0);",
     {0.25, 0.5, 0.75, 0}},
    {"a_depth_that_is_written",
     "",
     "gl_FragDepth = clamp(gl_FragCoord.z + a.x, 0.0, 1.0); r = vec4(gl_FragDepth);",
     {0.25, 0.25, 0.25, 0.25}},
    {"a_table_that_is_constant",
     "const vec3 tones[3] = vec3[](vec3(0.1), vec3(0.5), vec3(0.95));",
     "int i = int(a.w); r = vec4(tones[i], tones[i - 1].x);",
     {0.95, 0.95, 0.95, 0.5}},
};

/// Answers with what it was asked: a shadow with its reference, a cube with its direction and level, another
/// with its number in the array and the coordinates.
Image answering(double number) {
    return [number](const ImageRequest& q) -> std::array<double, 4> {
        if (q.compares) return {q.reference, q.reference, q.reference, q.reference};
        if (q.dimensions == 3) return {q.coordinates[0], q.coordinates[1], q.coordinates[2], q.lod};
        return {number, q.coordinates[0], q.coordinates[1], 0};
    };
}

class Feature : public ::testing::TestWithParam<FeatureCase> {};

TEST_P(Feature, Runs) {
    const Program program = fragment_of(GetParam().body, GetParam().declarations);
    Invocations invocations;
    invocations.values["a"] = {0.25, 0.5, 0.75, 2};
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const Port& port : *ports) {
            if (port.name == "k") invocations.values["k"] = {3};
            if (port.name == "which") invocations.values["which"] = {2};
            if (port.name == "Table.rows[4]") invocations.values[port.name] = {4, 40, 400, 4000};
        }
    for (const ImagePort& image : program.images)
        invocations.images[image.name] = answering(image.name.starts_with("maps[") ? image.name[5] - '0' : 0);
    const Result<Outputs> outputs = run<float>(program, invocations);
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    for (std::size_t c = 0; c < 4; ++c)
        EXPECT_FLOAT_EQ(static_cast<float>(outputs->values.at("r")[c]),
                        static_cast<float>(GetParam().expected[c]))
            << c;
}

INSTANTIATE_TEST_SUITE_P(Families, Feature, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Feature, TheGeometricNormalOfAQuadAndWhatIsDiscardedInIt) {
    const Program program = fragment_of(
        "vec3 n = normalize(cross(dFdx(a.xyz), dFdy(a.xyz))); if (a.x + a.y > 1.5) discard; r = vec4(n, "
        "1.0);");
    Invocations invocations;
    invocations.count = 4;
    // The plane z = x, at the four pixels of a quad: its normal is (-1, 0, 1).
    invocations.values["a"] = {0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const Result<Outputs> outputs = run<double>(program, invocations);
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    EXPECT_THAT(outputs->discarded, ::testing::ElementsAre(false, false, false, true));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(outputs->values.at("r")[i], -std::sqrt(0.5), 1e-15);
        EXPECT_NEAR(outputs->values.at("r")[8 + i], std::sqrt(0.5), 1e-15);
    }
}

}  // namespace
}  // namespace gobo::evaluate
