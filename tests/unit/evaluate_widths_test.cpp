// Numbers of 8, 16 and 64 bits.
#include <cstring>

#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

struct Case {
    const char* name;
    const char* body;
    std::vector<double> expected;
    const char* declarations = "";
};

constexpr const char* kTypes = R"(#extension GL_EXT_shader_explicit_arithmetic_types : require
layout(location = 3) flat in int i;
layout(location = 4) flat in int j;
)";

Result<Program> decoded(const Case& row) {
    const std::string source = std::string("#version 450\n") + kTypes +
                               "layout(location = 0) in vec4 a;\nlayout(location = 0) out vec4 r;\n" +
                               row.declarations + "\nvoid main() {\n" + row.body + "\n}\n";
    return decode(compile(ShaderStage::fragment, source), {.widths = Widths::up_to_64});
}

const std::map<std::string, std::vector<double>, std::less<>> kValues = {
    {"a", {10, 20, 30, 40}}, {"i", {1}}, {"j", {3}}};

// a = (10, 20, 30, 40), i = 1, j = 3.
const Case kNarrow[] = {
    {"half_is_rounded",  // 2049 lies between 2048 and 2050, 1/3 is 0x1.554p-2
     "float16_t h = float16_t(2039.0 + a.x); float16_t t = float16_t(i) / float16_t(j); r = vec4(h, t, 0, "
     "0);",
     {2048, 0x1.554p-2, 0, 0}},
    {"half_rounds_after_each_operation",  // 2048 + 1 stays 2048, each time
     "float16_t h = float16_t(2038.0 + a.x); h += float16_t(i); h += float16_t(i); r = vec4(h, 0, 0, 0);",
     {2048, 0, 0, 0}},
    {"half_overflows",
     "float16_t h = float16_t(a.w * 50.0); h = h * h; r = vec4(isinf(h), 0, 0, 0);",
     {1, 0, 0, 0}},
    {"half_constants",
     "float16_t h = float16_t(i); r = vec4(h * 0.1hf, h * -65504.0hf, h * 5.9604645e-8hf, 0);",
     {0x1.998p-4, -65504, 0x1p-24, 0}},
    {"half_vectors",
     "f16vec4 h = f16vec4(a) * float16_t(0.5); r = vec4(dot(h, h), length(h.xy), (f16mat2(h) * h.zw).x, "
     "h.w);",
     {750, 0x1.65cp3, 375, 20}},
    {"half_bits",
     "float16_t h = uint16BitsToFloat16(uint16_t(0x3c00 + i)); r = vec4(h, float16BitsToUint16(h), "
     "float16BitsToInt16(-h), 0);",
     {1 + 0x1p-10, 15361, -17407, 0}},
    {"short_wraps",
     "int16_t s = int16_t(32766 + j); uint16_t u = uint16_t(i) - uint16_t(j); r = vec4(s, u, u >> 1us, s / "
     "2s);",
     {-32767, 65534, 32767, -16383}},
    {"byte_wraps",
     "int8_t s = int8_t(126 + j); uint8_t u = uint8_t(i) - uint8_t(j); r = vec4(s, u, int(s) * 2, -int(u));",
     {-127, 254, -254, -254}},
    {"short_compares",
     "int16_t s = int16_t(-i); uint16_t u = uint16_t(s); r = vec4(s < 0s, u > 65000us, max(u, 7us), min(s, "
     "7s));",
     {1, 1, 65535, -1}},
    {"shorts_in_a_block",
     "r = vec4(table.halves[i], table.shorts[i], table.bytes[i], 0);",
     {1.5, -2, 200, 0},
     "layout(std430, binding = 0) buffer Table { float16_t halves[3]; int16_t shorts[3]; uint8_t bytes[3]; } "
     "table;"},
};

const Case kWide[] = {
    {"double_keeps_its_digits",
     "double d = 1.0lf + double(i) / 1099511627776.0lf; r = vec4((d - 1.0lf) * 1099511627776.0lf, 0, 0, 0);",
     {1, 0, 0, 0}},
    {"double_range",
     "double d = double(a.x) * 1e300lf; r = vec4(d * 1e-299lf, isinf(d), 0, 0);",
     {100, 0, 0, 0}},
    {"double_constants", "r = vec4(float(0.1lf * 1e17lf - 1e16lf + double(i)), 0, 0, 0);", {1, 0, 0, 0}},
    {"double_functions",
     "dvec3 d = dvec3(a.xyz); r = vec4(sqrt(d.x * d.x), length(dvec2(3.0lf, 4.0lf)), floor(d.y / 3.0lf), "
     "clamp(d.z, 0.0lf, 5.0lf));",
     {10, 5, 6, 5}},
    {"double_matrices",
     "dmat2x3 m = dmat2x3(dvec3(a.xyz), dvec3(1.0lf)); r = vec4(m * dvec2(2.0lf, i), determinant(dmat2(a)));",
     {21, 41, 61, -200}},
    {"double_bits",
     "uvec2 u = unpackDouble2x32(double(j) * 0.5lf); r = vec4(u.y, u.x, packDouble2x32(uvec2(0u, "
     "0x40080000u)), 0);",
     {1073217536, 0, 3, 0}},
    {"double_by_variable",
     "double d[3] = double[](1.5lf, 2.5lf, 1e40lf); r = vec4(d[i], d[i + 1] * 1e-39lf, 0, 0);",
     {2.5, 10, 0, 0}},
    {"long_product",
     "int64_t l = int64_t(4000000000u) * int64_t(-j); r = vec4(l / 1000000l, -l % 7l, l < 0l, 0);",
     {-12000, 2, 1, 0}},
    {"long_shifts",
     "int64_t l = int64_t(-j) << 40; uint64_t u = uint64_t(l); r = vec4(l >> 40, u >> 62, u >> 40ul, 0);",
     {-3, 3, 16777213, 0}},
    {"long_unsigned",
     "uint64_t u = 0xfffffffffffffffful - uint64_t(j); r = vec4(u > 1ul, u % 10ul, u / "
     "1000000000000000000ul, "
     "max(u, 1ul) == u);",
     {1, 2, 18, 1}},
    {"long_converts",
     "int64_t l = int64_t(uint(-i)); double d = double(l); r = vec4(d, uint(l), int(int64_t(-a.x)), "
     "int64_t(1e12) / 1000000000000l);",
     {4294967296, 4294967296, -10, 1}},
    {"long_packs",
     "uint64_t u = packUint2x32(uvec2(uint(j), uint(i))); uvec2 v = unpackUint2x32(u * 2ul); r = vec4(u >> "
     "32, v, 0);",
     {1, 6, 2, 0}},
    {"doubles_in_a_block",
     "r = vec4(table.d[i], table.m[1], table.l >> 33);",
     {0.25, 3, 4, 2},
     "layout(std140, binding = 0) uniform Table { double d[2]; dmat2 m; uint64_t l; } table;"},
    {"a_float_stays_single",
     "double d = 0.5lf; float f = a.x + 1e-7; r = vec4(f == 10.0, d, 0, 0);",
     {1, 0.5, 0, 0}},
};

/// What the blocks of the rows hold.
std::map<std::string, std::vector<std::byte>, std::less<>> blocks_of(const Program& program) {
    std::map<std::string, std::vector<std::byte>, std::less<>> blocks;
    for (const UniformBlock& block : program.uniform_blocks) {
        std::vector<std::byte>& bytes = blocks[block.name];
        bytes.resize(block.size);
        const auto put = [&](std::size_t at, auto number) {
            std::memcpy(bytes.data() + at, &number, sizeof number);
        };
        if (program.has_wide) {  // d at 0 and 16, the columns of m at 32 and 48, l at 64
            put(16, 0.25);
            put(48, 3.0);
            put(56, 4.0);
            put(64, std::uint64_t{2} << 33U);
        } else {  // halves at 0, 2, 4, shorts at 6, 8, 10, bytes at 12, 13, 14
            put(2, std::uint16_t{0x3e00});
            put(8, std::int16_t{-2});
            put(13, std::uint8_t{200});
        }
    }
    return blocks;
}

void expect_row(const Case& row, const Result<Outputs>& outputs) {
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    EXPECT_EQ(outputs->values.at("r"), row.expected);
}

class Narrow : public ::testing::TestWithParam<Case> {};

TEST_P(Narrow, IsAsWideAsItsType) {
    const Result<Program> program = decoded(GetParam());
    ASSERT_TRUE(program) << to_text(program.error().front());
    EXPECT_TRUE(program->has_narrow);
    Invocations invocations;
    invocations.values = kValues;
    invocations.blocks = blocks_of(*program);
    expect_row(GetParam(), run<float>(*program, invocations));
}

INSTANTIATE_TEST_SUITE_P(Bodies, Narrow, ::testing::ValuesIn(kNarrow),
                         [](const auto& one) { return std::string(one.param.name); });

class Wide : public ::testing::TestWithParam<Case> {};

TEST_P(Wide, IsAsWideAsItsType) {
    const Result<Program> program = decoded(GetParam());
    ASSERT_TRUE(program) << to_text(program.error().front());
    EXPECT_TRUE(program->has_wide);
    Invocations invocations;
    invocations.values = kValues;
    invocations.blocks = blocks_of(*program);
    expect_row(GetParam(), run<double>(*program, invocations, {.is_single = true}));
    EXPECT_FALSE(run<float>(*program, invocations));
}

INSTANTIATE_TEST_SUITE_P(Bodies, Wide, ::testing::ValuesIn(kWide),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Widths, AreRefusedByThoseWhoDoNotKnowThem) {
    const auto error = [](const char* body, Widths widths) {
        const auto words = compile(ShaderStage::fragment,
                                   std::string("#version 450\n") + kTypes +
                                       "layout(location = 0) out vec4 r;\nvoid main() {\n" + body + "\n}\n");
        const Result<Program> program = decode(words, {.widths = widths});
        return program ? std::string() : to_text(program.error().front());
    };
    EXPECT_EQ(error("int64_t l = int64_t(i);\nr = vec4(l);", Widths::up_to_32),
              "test.glsl:7: error: 64-bit integers are evaluated by gobo eval alone: searches compute in 32 "
              "bits\n");
    EXPECT_EQ(error("r = vec4(float16_t(i));", Widths::of_32),
              "test.glsl:7: error: 16-bit floating-point numbers are evaluated by gobo eval, gobo sanitize "
              "and gobo "
              "test alone\n");
    EXPECT_EQ(error("r = vec4(float16_t(i));", Widths::up_to_32), "");
}

}  // namespace
}  // namespace gobo::evaluate
