// Uniform blocks and their bytes, dynamic indices, composites, integers and bits.
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

using ::testing::ElementsAre;

constexpr const char* kBlocks = R"(
struct PointLight { vec4 position; vec3 color; float intensity; };
layout(std140, binding = 1) uniform PointLights { int count; PointLight lights[3]; } all;
layout(std140, binding = 2) uniform Matrices { mat3 columns; layout(row_major) mat3 rows; mat2x3 wide; float weights[3]; };
uniform float plain;
)";

std::map<std::string, std::vector<double>, std::less<>> none() {
    return {};
}

template <class Number>
void put(std::vector<std::byte>& bytes, std::size_t offset, Number number) {
    std::memcpy(bytes.data() + offset, &number, sizeof number);
}

TEST(Uniforms, ArraysOfStructsAreNamedAsOpenGlNamesThem) {
    const Program program = fragment_of(
        "r = vec4(all.lights[1].color * all.lights[2].intensity, float(all.count) + plain);", kBlocks);
    auto values = none();
    values["PointLights.lights[1].color"] = {1, 2, 3};
    values["PointLights.lights[2].intensity"] = {10};
    values["PointLights.count"] = {4};
    values["plain"] = {0.5};
    EXPECT_THAT(output_of<float>(program, values), ElementsAre(10, 20, 30, 4.5));
}

TEST(Uniforms, BytesAreReadByTheirStd140Layout) {
    const Program program = fragment_of(
        "r = vec4(all.lights[2].intensity, (columns * vec3(1.0, 10.0, 100.0)).y, (rows * vec3(1.0, 10.0, "
        "100.0)).y, "
        "wide[1][2] + weights[2]);",
        kBlocks);
    std::vector<std::byte> lights(16 + 3 * 32);
    put(lights, 16 + 2 * 32 + 28, 7.5F);
    // mat3 columns at 0, mat3 rows at 48 (each row 16 bytes), mat2x3 at 96, float[3] at 128 with stride 16.
    std::vector<std::byte> matrices(176);
    for (std::size_t column = 0; column < 3; ++column)
        put(matrices, column * 16 + 4, static_cast<float>(column + 1));
    for (std::size_t column = 0; column < 3; ++column)
        put(matrices, 48 + 16 + column * 4, static_cast<float>(column + 4));
    put(matrices, 96 + 16 + 8, 0.25F);
    put(matrices, 128 + 32, 2.0F);
    Invocations invocations;
    invocations.blocks = {{"PointLights", lights}, {"Matrices", matrices}};
    const Result<Outputs> outputs = run<double>(program, invocations);
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    EXPECT_THAT(outputs->values.at("r"), ElementsAre(7.5, 321, 654, 2.25));
}

TEST(Uniforms, MayDifferFromInvocationToInvocation) {
    const Program program = fragment_of("r = vec4(plain);", kBlocks);
    Invocations invocations;
    invocations.count = 3;
    invocations.values["plain"] = {1, 2, 3};
    const Result<Outputs> outputs = run<float>(program, invocations);
    ASSERT_TRUE(outputs);
    EXPECT_THAT(outputs->values.at("r"), ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3));
}

TEST(Constants, AreTheirShortestDecimalInDouble) {
    const Program program = fragment_of("r = vec4(0.1, 1.0 / 3.0, 3.14159274, 16777217.0);");
    EXPECT_THAT(output_of<double>(program, none()), ElementsAre(0.1, 0.33333334, 3.1415927, 16777216.0));
    EXPECT_THAT(output_of<float>(program, none()), ElementsAre(0.1F, 1.0F / 3.0F, 3.14159274F, 16777216.0F));
}

struct Case {
    const char* name;
    const char* body;
    std::vector<double> expected;
};

const Case kCases[] = {
    {"dynamic_read",
     "float w[4] = float[4](1.0, 2.0, 3.0, 4.0); r = vec4(w[i], w[3 - i], w[j], a[i]);",
     {2, 3, 4, 20}},
    {"dynamic_write",
     "float w[4] = float[4](0.0, 0.0, 0.0, 0.0); w[i] = 5.0; w[j] += 6.0; r = vec4(w[0], w[1], w[2], w[3]);",
     {0, 5, 0, 6}},
    {"dynamic_two_levels",
     "vec3 w[2]; w[0] = vec3(1.0, 2.0, 3.0); w[1] = vec3(4.0, 5.0, 6.0); w[i][j - 1] = 9.0; r = vec4(w[1], "
     "w[0][i]);",
     {4, 5, 9, 2}},
    {"index_beyond_the_end_is_clamped",
     "float w[4] = float[4](1.0, 2.0, 3.0, 4.0); r = vec4(w[j + 5], w[i - 7], w[i], 0.0);",
     {4, 1, 2, 0}},
    {"dynamic_component",
     "vec4 v = a; v[i] = 7.0; r = vec4(v[i], v[j], v.x, (a * 2.0)[i]);",
     {7, 40, 10, 40}},
    {"matrix_column",
     "mat3 m = mat3(1.0); m[i] = vec3(4.0, 5.0, 6.0); r = vec4(m[1], m[i][i]);",
     {4, 5, 6, 5}},
    {"matrix_times_vector",
     "r = vec4(mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0) * vec3(a), 0.0);",
     {300, 360, 420, 0}},
    {"vector_times_matrix",
     "r = vec4(vec3(a) * mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0), 0.0);",
     {140, 320, 500, 0}},
    {"matrix_times_matrix",
     "mat2 m = mat2(1.0, 2.0, 3.0, 4.0) * mat2(a); r = vec4(m[0], m[1]);",
     {70, 100, 150, 220}},
    {"not_square",
     "mat2x3 m = mat2x3(a.xyz, a.yzw); r = vec4(m * vec2(1.0, 2.0), (transpose(m) * vec3(1.0, 0.0, 1.0)).y);",
     {50, 80, 110, 60}},
    {"outer_product",
     "mat2x3 m = outerProduct(a.xyz, vec2(2.0, 3.0)); r = vec4(m[1], m[0].x);",
     {30, 60, 90, 20}},
    {"matrix_plus_and_times_number",
     "mat2 m = (mat2(a) + mat2(1.0)) * 2.0; r = vec4(m[0], m[1]);",
     {22, 40, 60, 82}},
    {"transpose", "mat2 m = transpose(mat2(a)); r = vec4(m[0], m[1]);", {10, 30, 20, 40}},
    {"determinant",
     "r = vec4(determinant(mat2(a)), determinant(mat3(2.0, 0.0, 1.0, 0.0, 3.0, 0.0, 1.0, 0.0, 4.0)), "
     "determinant(mat4(2.0)), 0.0);",
     {-200, 21, 16, 0}},
    {"inverse",
     "mat3 m = inverse(mat3(2.0, 0.0, 1.0, 0.0, 4.0, 0.0, 1.0, 0.0, 1.0)); r = vec4(m[0], m[1].y);",
     {1, 0, -1, 0.25}},
    {"inverse_of_4",
     "mat4 m = inverse(mat4(2.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 8.0, 0.0, 1.0, 2.0, 3.0, "
     "1.0)); r = m[3];",
     {-0.5, -0.5, -0.375, 1}},
    {"structs",
     "struct S { float x; vec2 y[2]; }; S s = S(1.0, vec2[2](a.xy, a.zw)); S u = s; u.y[i].x = 3.0; r = "
     "vec4(s.y[1].x, u.y[1].x, u.y[0].y, s == u ? 1.0 : 0.0);",
     {30, 3, 20, 0}},
    {"swizzles", "vec4 v = a; v.zx = v.xy; r = v.wzyx;", {40, 10, 20, 20}},
    {"integers", "r = vec4(7 / 2, -7 / 2, 7 % 3 + (j << 2), (j ^ 5) & 6);", {3, -3, 13, 6}},
    {"unsigned",
     "uint u = uint(j) - 4u; r = vec4(u > 10u, u >> 31, u / 2147483648u, float(u));",
     {1, 1, 1, 4294967295.0}},
    {"shift_right_of_negative",
     "int n = -i * 9; r = vec4(n >> 1, uint(n) >> 28, n >> 31, ~i);",
     {-5, 15, -1, -2}},
    {"conversions",
     "r = vec4(int(-2.75 * a.x), uint(a.y + 0.9), float(i) / 2.0, float(bool(j)));",
     {-27, 20, 0.5, 1}},
    {"conversion_of_too_much_is_clamped",
     "r = vec4(int(a.x * 1e30), int(-a.x * 1e30), uint(-a.x), uint(a.x * 1e30));",
     {2147483647, -2147483648.0, 0, 4294967295.0}},
    {"bits_of_floats",
     "r = vec4(floatBitsToInt(a.x), intBitsToFloat(0x40490fdb), uintBitsToFloat(0x3f800000u), "
     "floatBitsToUint(-1.0) >> 24);",
     {1092616192, 3.1415927410125732, 1, 191}},
    {"bit_fields",
     "r = vec4(bitfieldExtract(0xabcd, 4, 8), bitfieldExtract(-16, 2, 4), bitfieldInsert(0, 5, 4, 3), "
     "bitfieldReverse(i));",
     {-68, -4, 80, -2147483648.0}},
    {"bit_counts", "r = vec4(bitCount(0xff0f), findLSB(40), findMSB(j), findMSB(-i));", {12, 3, 1, -1}},
    {"integer_functions",
     "r = vec4(abs(-i * 4), sign(-j), clamp(j * 10, 0, 25), min(i, j) * 10 + max(i, j));",
     {4, -1, 25, 13}},
    {"carries",
     "uint c; uint s = uaddCarry(4000000000u, uint(j) * 100000000u, c); uint b; uint d = usubBorrow(uint(i), "
     "2u, b); r = vec4(s, c, d, b);",
     {5032704, 1, 4294967295.0, 1}},
    {"wide_products",
     "uint h, l; umulExtended(4000000000u, uint(j), h, l); int sh, sl; imulExtended(-2000000000, j, sh, sl); "
     "r = vec4(h, l, sh, sl);",
     {2, 3410065408.0, -2, -1705032704.0}},
    {"modf",
     "float whole; float part = modf(-a.x * 0.275, whole); r = vec4(whole, part, 0.0, 0.0);",
     {-2, -0.75, 0, 0}},
    {"frexp", "int e; float s = frexp(a.z, e); r = vec4(s, e, ldexp(s, e), 0.0);", {0.9375, 5, 30, 0}},
    {"pack_half",
     "uint p = packHalf2x16(vec2(1.0 + a.x * 0.0, -65504.0)); vec2 u = unpackHalf2x16(p); r = vec4(p & "
     "0xffffu, p >> 16, u);",
     {15360, 64511, 1, -65504}},
    {"half_rounds_to_even_and_overflows",
     "vec4 v = a * 0.0; r = vec4(unpackHalf2x16(packHalf2x16(vec2(2049.0, 2051.0) + v.xy)), "
     "unpackHalf2x16(packHalf2x16(vec2(5.9604645e-8, 0.00006103515625) + v.xy)));",
     {2048, 2052, 5.9604644775390625e-8, 0.00006103515625}},
    {"pack_unorm",
     "uint p = packUnorm4x8(vec4(0.0, 1.0, 0.5, 2.0) + a * 0.0); r = vec4(p & 255u, p >> 8 & 255u, p >> 16 & "
     "255u, p >> 24);",
     {0, 255, 128, 255}},
    {"pack_snorm", "r = unpackSnorm4x8(packSnorm4x8(vec4(-1.0, 1.0, 0.0, -3.0) + a * 0.0));", {-1, 1, 0, -1}},
    {"pack_16",
     "r = vec4(unpackUnorm2x16(packUnorm2x16(vec2(0.0, 1.0) + a.xy * 0.0)), "
     "unpackSnorm2x16(packSnorm2x16(vec2(-1.0, 1.0) + a.xy * 0.0)));",
     {0, 1, -1, 1}},
    {"logic",
     "bvec4 v = lessThan(a, vec4(25.0)); r = vec4(any(v), all(v), any(not(v)) != v.x, v.x == v.z);",
     {1, 0, 0, 0}},
    {"comparisons",
     "r = vec4(a.x <= 10.0, a.x != 10.0, i != j, uint(i) < uint(j)) + vec4(equal(a, a.xxxx)) * 2.0;",
     {3, 0, 1, 1}},
};

class Values : public ::testing::TestWithParam<Case> {};

/// a = (10, 20, 30, 40), i = 1, j = 3.
TEST_P(Values, AreTheSameInBothArithmetics) {
    const Program program = fragment_of(
        GetParam().body, "layout(location = 3) flat in int i;\nlayout(location = 4) flat in int j;\n");
    const std::map<std::string, std::vector<double>, std::less<>> values = {
        {"a", {10, 20, 30, 40}}, {"i", {1}}, {"j", {3}}};
    // Whole numbers and short binary fractions: exact, but for results above 2^24 in fp32.
    EXPECT_EQ(output_of<double>(program, values), GetParam().expected);
    std::vector<double> rounded;
    for (const double value : GetParam().expected) rounded.push_back(static_cast<float>(value));
    EXPECT_EQ(output_of<float>(program, values), rounded);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Values, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Denormals, AreKeptOrFlushed) {
    const Program program = fragment_of("r = vec4(a.x * 0.5, a.y, 0.0, 0.0);");
    Invocations invocations;
    invocations.values["a"] = {0x1p-126, 1, 0, 0};
    const Result<Outputs> kept = run<float>(program, invocations);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->values.at("r")[0], 0x1p-127);
    Options options;
    options.flush_denormals = true;
    const Result<Outputs> flushed = run<float>(program, invocations, options);
    ASSERT_TRUE(flushed);
    EXPECT_EQ(flushed->values.at("r")[0], 0);
    const Result<Outputs> in_double = run<double>(program, invocations, options);
    ASSERT_TRUE(in_double);
    EXPECT_EQ(in_double->values.at("r")[0], 0x1p-127);
}

TEST(Vertex, BuiltInsAreInputsAndOutputs) {
    const Program program = program_of(ShaderStage::vertex, R"(#version 330
layout(location = 0) in vec3 position;
uniform mat4 model;
out vec3 normal;
void main() {
    gl_Position = model * vec4(position, 1.0);
    gl_PointSize = float(gl_VertexID + gl_InstanceID * 10);
    gl_ClipDistance[0] = -position.x;
    normal = mat3(model) * position;
})");
    std::map<std::string, std::vector<double>, std::less<>> values = {
        {"position", {1, 2, 3}}, {"gl_VertexID", {4}}, {"gl_InstanceID", {2}}};
    values["model"] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 5, 6, 7, 1};
    EXPECT_THAT(output_of<float>(program, values, "gl_Position"), ElementsAre(6, 10, 16, 1));
    EXPECT_THAT(output_of<float>(program, values, "gl_PointSize"), ElementsAre(24));
    EXPECT_THAT(output_of<float>(program, values, "gl_ClipDistance[0]"), ElementsAre(-1));
    EXPECT_THAT(output_of<float>(program, values, "normal"), ElementsAre(1, 4, 9));
}

TEST(Fragment, BuiltInsAreInputsAndOutputs) {
    const Program program =
        fragment_of("r = gl_FragCoord * (gl_FrontFacing ? 2.0 : 3.0); gl_FragDepth = gl_FragCoord.z * 0.5;");
    std::map<std::string, std::vector<double>, std::less<>> values = {{"gl_FragCoord", {0.5, 1.5, 0.25, 1}},
                                                                      {"gl_FrontFacing", {1}}};
    EXPECT_THAT(output_of<float>(program, values), ElementsAre(1, 3, 0.5, 2));
    EXPECT_THAT(output_of<float>(program, values, "gl_FragDepth"), ElementsAre(0.125));
}

TEST(Fragment, Es300IsReadToo) {
    const Program program = program_of(ShaderStage::fragment, R"(#version 310 es
precision highp float;
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 color;
void main() { color = vec4(normalize(normal), 1.0); })");
    EXPECT_THAT(output_of<double>(program, {{"normal", {0, 3, 4}}}, "color"), ElementsAre(0, 0.6, 0.8, 1));
}

}  // namespace
}  // namespace gobo::evaluate
