// Textures as the sanitizer sees them: texels within their domain, each of its own, what texture functions
// must not be given, and derivatives in quads.
#include <ostream>

#include <gtest/gtest.h>

#include "sanitize_support.hpp"

namespace gobo {
namespace {

struct Row {
    std::string name;
    std::string statement;  ///< in line 9
    Lines found;            ///< none of a harmless one
    std::vector<Domain> domains = {};
};

std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
}

constexpr const char* kParted = "9: derivatives where neighbouring pixels go another way";
constexpr const char* kOutside = "9: texelFetch() outside of the texture";

const Row kRows[] = {
    {"bright_texel",
     "color = sqrt(4.0 - texture(map, uv));",
     {"9: sqrt() of a negative number"},
     {domain("map", 0, 65504)}},
    {"signed_texel",
     "color = sqrt(texture(map, uv));",
     {"9: sqrt() of a negative number"},
     {domain("map", -1, 1)}},
    {"one_channel",
     "color.r = sqrt(1.0 - texture(map, uv).a);",
     {"9: sqrt() of a negative number"},
     {domain("map.a", 0, 2)}},
    {"two_texels",
     "color.r = sqrt(0.5 + texture(map, uv).r - texture(map, uv + vec2(0.01, 0.0)).r);",
     {"9: sqrt() of a negative number"}},
    {"two_levels",
     "color.r = 1.0 / (1.0 - abs(textureLod(map, uv, 0.0).r - textureLod(map, uv, 3.0).r));",
     {"9: division by zero"}},
    {"gathered",
     "vec4 four = textureGather(map, uv); color.r = 1.0 / (1.0 - abs(four.x - four.z));",
     {"9: division by zero"}},
    {"integer_texel", "color.r = table[texture(ids, uv).r];", {"9: array index out of bounds"}},
    {"integer_in_its_domain",
     "color.r = table[texture(ids, uv).r];",
     {"9: array index out of bounds"},
     {domain("ids", 0, 4)}},
    {"projected",
     "color = textureProj(map, vec3(uv, uv.x));",
     {"9: a projected texture coordinate whose divisor is not above 0"},
     {domain("uv", -1, 1)}},
    {"cube_of_nothing", "color = texture(sky, v);", {"9: a cube map is looked up along a zero vector"}},
    {"fetch_below_zero", "color = texelFetch(map, ivec2(uv * 10.0 - 1.0), 0);", {kOutside}},
    {"fetch_beyond_a_stated_side",
     "color = texelFetch(map, ivec2(uv * 256.0), 0);",
     {kOutside},
     {domain("map.side", 256, 256)}},
    {"fetch_beyond_a_smaller_level",
     "color = texelFetch(map, ivec2(uv * 255.0), 1);",
     {kOutside},
     {domain("map.side", 256, 256)}},
    {"no_such_level",
     "color = texelFetch(map, ivec2(0), 3);",
     {"9: a level that the texture does not have"},
     {domain("map.levels", 1, 3)}},
    {"size_of_no_such_level",
     "color.r = float(textureSize(map, int(v.x)).x);",
     {"9: a level that the texture does not have"}},
    {"small_texture",
     "color.r = 1.0 / float(textureSize(map, 0).x - 1);",
     {"9: division by zero"},
     {domain("map.side", 1, 64)}},
    {"parted_texture", "if (v.x > 0.0) color = texture(map, uv);", {kParted}},
    {"parted_derivative", "if (v.x > 0.0) color.r = dFdx(uv.x);", {kParted}},
    {"parted_by_a_loop", "for (int k = 0; k < int(uv.x * 4.0); ++k) color += texture(map, uv);", {kParted}},
    {"derivative_as_divisor", "color.r = 1.0 / (dFdx(uv.x) - 0.5);", {"9: division by zero"}},
    {"derivative_of_a_texel",
     "color.r = sqrt(0.5 - dFdy(texture(map, uv).r));",
     {"9: sqrt() of a negative number"}},
    {"size_of_a_derivative",
     "color.r = inversesqrt(fwidth(uv.x));",
     {"9: inversesqrt() of a number not above 0"}},
    // What must stay silent.
    {"harmless_texel", "color = sqrt(4.0 - texture(map, uv)) + sqrt(texture(map, v.xy));", {}},
    {"harmless_same_texel", "color.r = sqrt(0.5 + texture(map, uv).r - texture(map, uv).r);", {}},
    {"harmless_integer", "color.r = table[clamp(texture(ids, uv).r, 0, 3)];", {}},
    {"harmless_integer_domain", "color.r = table[texture(ids, uv).r];", {}, {domain("ids", 0, 3)}},
    {"harmless_projection", "color = textureProj(map, vec3(uv, 1.0 + uv.x));", {}},
    {"harmless_cube", "color = texture(sky, vec3(v.xy, 1.0));", {}},
    {"harmless_fetch", "color = texelFetch(map, ivec2(uv * 10.0), 0);", {}},
    {"harmless_stated_fetch",
     "color = texelFetch(map, ivec2(uv * 255.0), 0);",
     {},
     {domain("map.side", 256, 256)}},
    {"harmless_level", "color = textureLod(map, uv, 30.0);", {}},
    {"harmless_uniform_flow", "if (on) color = texture(map, uv) + vec4(dFdx(uv.x));", {}},
    {"harmless_before_discard", "color = texture(map, uv); if (v.x > 0.0) discard;", {}},
    {"harmless_gradients",
     "vec2 dx = dFdx(uv), dy = dFdy(uv); if (v.x > 0.0) color = textureGrad(map, uv, dx, dy);",
     {}},
    {"harmless_parted_level", "if (v.x > 0.0) color = textureLod(map, uv, 0.0);", {}},
    {"harmless_derivative", "color.r = sqrt(1.0 - abs(dFdx(uv.x)));", {}},
};

std::string shader_with(const std::string& statement) {
    return "#version 450\n"
           "in vec2 uv; in vec3 v;\n"
           "uniform bool on; uniform float table[4];\n"
           "uniform sampler2D map; uniform samplerCube sky;\n"
           "uniform isampler2D ids;\n"
           "out vec4 color;\n"
           "void main() {\n"
           "    color = vec4(0.0);\n    " +
           statement + "\n}\n";
}

/// uv lies within [0, 1] unless a row says otherwise.
std::vector<Domain> domains_of(const Row& row) {
    std::vector<Domain> domains = row.domains;
    domains.push_back(domain("uv", 0, 1));
    return domains;
}

class Texture : public testing::TestWithParam<Row> {};

TEST_P(Texture, IsWatched) {
    const std::string text = shader_with(GetParam().statement);
    const sanitize::SanitizeReport report = sanitized_text("texture.frag", text, {}, domains_of(GetParam()));
    EXPECT_EQ(found_lines(report), GetParam().found);
    EXPECT_EQ(not_replayed("texture.frag", text, report), Lines{});
}

INSTANTIATE_TEST_SUITE_P(Rows, Texture, testing::ValuesIn(kRows), row_name);

/// What does not matter to a finding is the same in all pixels of the quad that it is saved with.
TEST(Quad, IsAsSimpleAsItsFinding) {
    const sanitize::SanitizeReport report =
        sanitized_text("quad.frag", shader_with("color.r = 1.0 / v.x + dFdx(v.y);"), {});
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(eval_input(report.findings.front().finding, "a heading").find("]["), std::string::npos);
    EXPECT_EQ(report.findings.front().finding.point.inputs.at("v"), (std::vector<double>{0, 0, 0}));
}

}  // namespace
}  // namespace gobo
