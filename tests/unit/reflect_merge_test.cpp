// One interface from several: stages of a program, permutations of a family.
#include <gtest/gtest.h>

#include "reflect/reflect.hpp"
#include "reflect_compile.hpp"

namespace gobo {
namespace {

using testing::Stage;
using Names = std::vector<std::string>;

Interface reflected(Stage stage, const std::string& body) {
    const testing::Compiled compiled = testing::compile(stage, "#version 450\n" + body);
    EXPECT_EQ(compiled.log, "");
    return reflect_stage(compiled.spirv).value_or(Interface{});
}

Interface lights(int count) {
    const std::string extent = std::to_string(count);
    return reflected(Stage::fragment,
                     "struct Light { vec4 position; vec3 color; };\n"
                     "layout(binding = 2) uniform Lights { vec4 ambient; Light lights[" +
                         extent +
                         "]; };\n"
                         "void main() {}\n");
}

TEST(Merge, UnitesResourcesAndKeepsTheOuterVariables) {
    const Interface vertex = reflected(Stage::vertex, R"(
layout(binding = 1) uniform Camera { mat4 viewProjection; };
layout(binding = 5) uniform sampler2D heights;
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 normal;
void main() { gl_Position = viewProjection * vec4(position, 1.0); normal = position; }
)");
    const Interface fragment = reflected(Stage::fragment, R"(
layout(binding = 1) uniform Camera { mat4 viewProjection; };
layout(location = 4) uniform float exposure;
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 color;
void main() { color = vec4(normal, exposure); }
)");
    const Interface program = merge({vertex, fragment});
    EXPECT_EQ(program, merge({fragment, vertex}));
    EXPECT_EQ(program.stages, (Names{"vertex", "fragment"}));
    ASSERT_EQ(program.blocks.size(), 1u);
    EXPECT_EQ(program.blocks[0].stages, (Names{"vertex", "fragment"}));
    ASSERT_EQ(program.samplers.size(), 1u);
    EXPECT_EQ(program.samplers[0].stages, Names{"vertex"});
    ASSERT_EQ(program.uniforms.size(), 1u);
    EXPECT_EQ(program.uniforms[0].stages, Names{"fragment"});
    EXPECT_EQ(program.inputs, (std::vector<Variable>{{"position", "vec3", 0, {}}}));
    EXPECT_EQ(program.outputs, (std::vector<Variable>{{"color", "vec4", 0, {}}}));
}

TEST(Merge, OfNothingIsEmpty) {
    EXPECT_EQ(merge(std::vector<Interface>{}), Interface{});
}

TEST(Unite, KeepsTheLargestCountedArray) {
    for (const auto& order : {std::vector{1, 8, 3}, std::vector{8, 3, 1}, std::vector{3, 1, 8}}) {
        std::vector<Interface> programs;
        for (const int count : order) programs.push_back(lights(count));
        const Result<Interface> family = unite(programs);
        ASSERT_TRUE(family);
        EXPECT_EQ(*family, lights(8));
        EXPECT_EQ(family->blocks[0].size, 16 + 8 * 32);
    }
}

TEST(Unite, CollectsWhatOnlySomePermutationsHave) {
    const Interface fog = reflected(Stage::fragment, "uniform Fog { float near; };\nvoid main() {}\n");
    const Interface tone = reflected(Stage::fragment, "uniform Tone { float gain; };\nvoid main() {}\n");
    const Result<Interface> family = unite({tone, fog});
    ASSERT_TRUE(family);
    ASSERT_EQ(family->blocks.size(), 2u);
    EXPECT_EQ(family->blocks[0].name, "Fog");
    EXPECT_EQ(family->blocks[1].name, "Tone");
}

struct Conflict {
    const char* name;
    const char* first;
    const char* second;
    const char* error;
};

/// For messages of failed tests.
void PrintTo(const Conflict& row, std::ostream* stream) {
    *stream << row.name;
}

constexpr Conflict conflicts[] = {
    {"member_type", "uniform Fog { float near; };", "uniform Fog { int near; };", "Fog.near"},
    {"member_order", "uniform Fog { float near; float far; };", "uniform Fog { float far; float near; };",
     "Fog.near"},
    {"array_before_the_last", "uniform Fog { float w[2]; float far; };",
     "uniform Fog { float w[3]; float far; };", "Fog.w"},
    {"one_member_more", "uniform Fog { float a; };", "uniform Fog { float a; float b; };", "Fog"},
    {"block_binding", "layout(binding = 1) uniform Fog { float a; };",
     "layout(binding = 2) uniform Fog { float a; };", "Fog"},
    {"sampler_type", "uniform sampler2D map;", "uniform samplerCube map;", "map"},
    {"uniform_location", "layout(location = 1) uniform float gain;",
     "layout(location = 2) uniform float gain;", "gain"},
    {"output_type", "layout(location = 0) out vec4 color;", "layout(location = 0) out vec3 color;", "color"},
};

class Conflicting : public ::testing::TestWithParam<Conflict> {};

TEST_P(Conflicting, IsRefused) {
    const Conflict& row = GetParam();
    const Result<Interface> family =
        unite({reflected(Stage::fragment, row.first + std::string("\nvoid main() {}\n")),
               reflected(Stage::fragment, row.second + std::string("\nvoid main() {}\n"))});
    ASSERT_FALSE(family);
    EXPECT_EQ(to_text(family.error().front()),
              "gobo: error: '" + std::string(row.error) +
                  "' is declared differently in different permutations\n"
                  "  help: give it one declaration in a piece that every user includes, or two names\n");
}

INSTANTIATE_TEST_SUITE_P(Declarations, Conflicting, ::testing::ValuesIn(conflicts),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
