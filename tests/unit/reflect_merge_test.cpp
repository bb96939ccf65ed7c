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
        const United family = unite(programs);
        EXPECT_TRUE(family.differing.empty());
        EXPECT_EQ(family.interface, lights(8));
        EXPECT_EQ(family.interface.blocks[0].size, 16 + 8 * 32);
    }
}

TEST(Unite, CollectsWhatOnlySomePermutationsHave) {
    const Interface fog = reflected(Stage::fragment, "uniform Fog { float near; };\nvoid main() {}\n");
    const Interface tone = reflected(Stage::fragment, "uniform Tone { float gain; };\nvoid main() {}\n");
    const United family = unite({tone, fog});
    EXPECT_TRUE(family.differing.empty());
    ASSERT_EQ(family.interface.blocks.size(), 2u);
    EXPECT_EQ(family.interface.blocks[0].name, "Fog");
    EXPECT_EQ(family.interface.blocks[1].name, "Tone");
}

/// Three programs: the first two declare something each in its own way, the third as the first.
struct Pair {
    const char* name;
    const char* first;
    const char* second;
    const char* differing;  ///< "" where one declaration serves both
    const char* united;     ///< the declarations, in order
};

/// For messages of failed tests.
void PrintTo(const Pair& row, std::ostream* stream) {
    *stream << row.name;
}

constexpr Pair pairs[] = {
    {"member_type", "uniform Fog { float near; };", "uniform Fog { int near; };", "uniform block Fog 121",
     "Fog: float near; Fog: int near;"},
    {"member_order", "uniform Fog { float near; float far; };", "uniform Fog { float far; float near; };",
     "uniform block Fog 121", "Fog: float near; float far; Fog: float far; float near;"},
    {"array_before_the_last", "uniform Fog { float w[2]; float far; };",
     "uniform Fog { float w[3]; float far; };", "uniform block Fog 121",
     "Fog: float w[2]; float far; Fog: float w[3]; float far;"},
    {"one_member_more", "uniform Fog { float a; };", "uniform Fog { float a; float b; };",
     "uniform block Fog 121", "Fog: float a; Fog: float a; float b;"},
    {"last_array", "uniform Fog { float w[2]; };", "uniform Fog { float w[5]; };", "", "Fog: float w[5];"},
    {"block_binding", "layout(binding = 1) uniform Fog { float a; };",
     "layout(binding = 2) uniform Fog { float a; };", "uniform block Fog 121",
     "Fog at 1: float a; Fog at 2: float a;"},
    {"stated_binding", "uniform Fog { float a; };", "layout(binding = 2) uniform Fog { float a; };", "",
     "Fog at 2: float a;"},
    {"sampler_type", "uniform sampler2D map;", "uniform sampler2DShadow map;", "sampler map 121",
     "sampler2D map; sampler2DShadow map;"},
    {"sampler_count", "uniform sampler2D maps[1];", "uniform sampler2D maps[3];", "", "sampler2D maps[3];"},
    {"sampler_or_array", "uniform sampler2D map;", "uniform sampler2D map[2];", "sampler map 121",
     "sampler2D map; sampler2D map[2];"},
    {"uniform_location", "layout(location = 1) uniform float gain;",
     "layout(location = 2) uniform float gain;", "uniform gain 121", "float gain at 1; float gain at 2;"},
    {"uniform_count", "uniform vec3 path[2];", "uniform vec3 path[4];", "", "vec3 path[4];"},
    {"inner_extent", "uniform vec3 path[2][3];", "uniform vec3 path[2][4];", "uniform path 121",
     "vec3 path[2][3]; vec3 path[2][4];"},
    {"struct_members", "struct L { vec3 p; }; uniform L lights[2];",
     "struct L { float r; vec3 p; }; uniform L lights[3];", "", "L lights[3] { vec3 p; float r; };"},
    {"struct_member_type", "struct L { vec3 p; }; uniform L light;", "struct L { vec4 p; }; uniform L light;",
     "uniform light 121", "L light { vec3 p; }; L light { vec4 p; };"},
    {"output_type", "layout(location = 0) out vec4 color;", "layout(location = 0) out vec3 color;",
     "output color 121", "vec4 color at 0; vec3 color at 0;"},
};

template <class Entry>
std::string extents_of(const Entry& entry) {
    std::string text;
    for (const int extent : entry.array) text += "[" + std::to_string(extent) + "]";
    return text;
}

std::string members_text(const std::vector<Member>& members) {
    std::string text;
    for (const Member& member : members)
        text += " " + member.type + " " + member.name + extents_of(member) + ";";
    return text;
}

/// All lists of an interface on one line.
std::string short_text(const Interface& interface) {
    std::string text;
    const auto place_text = [](const auto& entry) {
        return place_of(entry) < 0 ? std::string() : " at " + std::to_string(place_of(entry));
    };
    for (const Block& block : interface.blocks)
        text += " " + block.name + place_text(block) + ":" + members_text(block.members);
    const auto add = [&](const auto& entries) {
        for (const auto& entry : entries) {
            text += " " + entry.type + " " + entry.name + extents_of(entry) + place_text(entry);
            if constexpr (requires { entry.members; })
                if (!entry.members.empty()) text += " {" + members_text(entry.members) + " }";
            text += ";";
        }
    };
    add(interface.uniforms);
    add(interface.samplers);
    add(interface.outputs);
    return text.empty() ? text : text.substr(1);
}

/// What the declaration gives a fragment stage that reads it; -1 where it states no place, as validation
/// leaves it.
Interface declared(const std::string& declaration) {
    Interface interface = reflected(Stage::fragment, declaration + "\nvoid main() {}\n");
    for (Sampler& sampler : interface.samplers) sampler.usage.unused = false;
    if (declaration.find("layout(") != std::string::npos) return interface;
    for (Block& block : interface.blocks) block.binding = -1;
    for (Uniform& uniform : interface.uniforms) uniform.location = -1;
    for (Sampler& sampler : interface.samplers) sampler.binding = -1;
    return interface;
}

class DeclaredDifferently : public ::testing::TestWithParam<Pair> {};

TEST_P(DeclaredDifferently, KeepsADeclarationForEachProgram) {
    const Interface first = declared(GetParam().first);
    const Interface second = declared(GetParam().second);
    const United family = unite({first, second, first});
    EXPECT_EQ(short_text(family.interface), GetParam().united);
    std::string differing;
    for (const Differing& found : family.differing) {
        differing += found.kind + " " + found.name + " ";
        for (const int number : found.declared) differing += std::to_string(number);
    }
    EXPECT_EQ(differing, GetParam().differing);
}

INSTANTIATE_TEST_SUITE_P(Declarations, DeclaredDifferently, ::testing::ValuesIn(pairs),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
