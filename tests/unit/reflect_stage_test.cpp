// What spirv-cross does not tell: plain uniforms, booleans, specialisation constants, unused variables; and
// how an interface is written out.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "reflect/interface_format.hpp"
#include "reflect/reflect.hpp"
#include "reflect_compile.hpp"
#include "reflect_unused.hpp"

namespace gobo {
namespace {

using testing::Stage;
using Names = std::vector<std::string>;

testing::Compiled compiled(const std::string& declarations, const std::string& body = "",
                           Stage stage = Stage::fragment) {
    testing::Compiled result =
        testing::compile(stage, "#version 450\n" + declarations + "\nvoid main() {" + body + "}\n");
    EXPECT_EQ(result.log, "");
    return result;
}

struct Text {
    const char* name;
    const char* declarations;
    const char* text;
};

/// For messages of failed tests.
void PrintTo(const Text& row, std::ostream* stream) {
    *stream << row.name;
}

constexpr Text texts[] = {
    {"empty", "", "stages: fragment\n"},
    {"plain_uniforms",
     "struct Surface { vec4 tint; float w[2]; mat3 basis; bool glossy; };\n"
     "layout(location = 3) uniform Surface surfaces[2]; layout(location = 20) uniform bool enabled;\n"
     "layout(location = 21) uniform mat4x3 map[2][3];",
     "stages: fragment\n"
     "\n"
     "uniforms:\n"
     "  bool     enabled      location 20  fragment  unused\n"
     "  mat4x3   map[2][3]    location 21  fragment  unused\n"
     "  Surface  surfaces[2]  location 3   fragment  unused\n"
     "    vec4     tint\n"
     "    float    w[2]\n"
     "    mat3     basis\n"
     "    bool     glossy\n"},
    {"samplers_in_a_struct",
     "struct Map { sampler2DShadow depth; float bias; }; layout(location = 7) uniform Map map;",
     "stages: fragment\n"
     "\n"
     "uniforms:\n"
     "  float  map.bias  location 8  fragment  unused\n"
     "\n"
     "samplers:\n"
     "  sampler2DShadow  map.depth  fragment  unused\n"},
    {"specialised_extents",
     "layout(constant_id = 1) const int COUNT = 5;\nconst int MORE = 2 * COUNT - 1;\n"
     "layout(binding = 3) uniform Weights { float w[COUNT]; float m[MORE]; };",
     "stages: fragment\n"
     "\n"
     "block Weights: binding 3, 224 bytes, fragment, unused\n"
     "      0  float  w[5]  array stride 16\n"
     "     80  float  m[9]  array stride 16\n"
     "\n"
     "specialisation constants:\n"
     "  int  COUNT  constant_id 1\n"},
    {"counters", "layout(binding = 0, offset = 4) uniform atomic_uint hits;",
     "stages: fragment\n"
     "\n"
     "uniforms:\n"
     "  atomic_uint  hits  fragment  unused\n"},
    {"varyings",
     "layout(location = 1) in Surface { vec3 normal; mat3 basis; flat ivec2 ids[2]; vec2 uv; } surface;\n"
     "struct Ray { dvec3 origin; vec3 direction; };\nlayout(location = 8) flat in Ray rays[2];\n"
     "layout(location = 0) out vec4 color[2];",
     "stages: fragment\n"
     "\n"
     "inputs:\n"
     "  mat3   Surface.basis      location 2   unused\n"
     "  ivec2  Surface.ids[2]     location 5   unused\n"
     "  vec3   Surface.normal     location 1   unused\n"
     "  vec2   Surface.uv         location 7   unused\n"
     "  vec3   rays[0].direction  location 10  unused\n"
     "  dvec3  rays[0].origin     location 8   unused\n"
     "  vec3   rays[1].direction  location 13  unused\n"
     "  dvec3  rays[1].origin     location 11  unused\n"
     "\n"
     "outputs:\n"
     "  vec4  color[2]  location 0  unused\n"},
};

class Written : public ::testing::TestWithParam<Text> {};

TEST_P(Written, AsText) {
    const Result<Interface> interface = reflect_stage(compiled(GetParam().declarations).spirv);
    ASSERT_TRUE(interface) << to_text(interface.error().front());
    EXPECT_EQ(to_text(*interface), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(Interfaces, Written, ::testing::ValuesIn(texts),
                         [](const auto& row) { return row.param.name; });

TEST(Json, HasTheWholeSchema) {
    const testing::Compiled stage = compiled(R"(
struct Light { vec3 color; };
layout(binding = 1) uniform Lights { layout(row_major) mat2x3 frame; Light lights[2]; };
layout(location = 3) uniform float exposure[2];
layout(binding = 4) uniform sampler2D map;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color[2];)");
    const Result<Interface> interface = reflect_stage(stage.spirv);
    ASSERT_TRUE(interface);
    const auto expected = nlohmann::ordered_json::parse(R"({
"stages": ["fragment"],
"blocks": [{"name": "Lights", "binding": 1, "size": 80, "stages": ["fragment"], "members": [
  {"name": "frame", "type": "mat2x3", "offset": 0, "array": [], "array_stride": 0, "matrix_stride": 16, "row_major": true, "members": []},
  {"name": "lights", "type": "Light", "offset": 48, "array": [2], "array_stride": 16, "matrix_stride": 0, "row_major": false, "members": [
    {"name": "color", "type": "vec3", "offset": 0, "array": [], "array_stride": 0, "matrix_stride": 0, "row_major": false, "members": []}]}], "unused": true}],
"uniforms": [{"name": "exposure", "type": "float", "location": 3, "array": [2], "members": [], "unused": true}],
"samplers": [{"name": "map", "type": "sampler2D", "binding": 4, "array": [], "unused": true}],
"inputs": [{"name": "uv", "type": "vec2", "location": 0, "unused": true}],
"outputs": [{"name": "color", "type": "vec4", "location": 0, "array": [2], "unused": true}]})");
    EXPECT_EQ(to_json(*interface).dump(1), expected.dump(1));
}

TEST(Bools, AreRestoredFromGlslangsTypes) {
    const testing::Compiled stage = compiled(R"(
struct Light { vec3 color; bool on; bvec3 channels[2]; uint id; };
layout(binding = 2) uniform Lights { Light lights[2][3]; bool all; uint count; } scene;
layout(binding = 1) uniform Fog { bool enabled; uvec2 size; };)");
    const Interface raw = *reflect_stage(stage.spirv);
    ASSERT_TRUE(may_hold_bools(raw));
    const Interface interface = restore_bools(raw, stage.types);
    EXPECT_EQ(to_text(interface),
              "stages: fragment\n"
              "\n"
              "block Fog: binding 1, 16 bytes, fragment, unused\n"
              "      0  bool   enabled\n"
              "      8  uvec2  size\n"
              "\n"
              "block Lights: binding 2, 400 bytes, fragment, unused\n"
              "      0    Light    lights[2][3]   array stride 192\n"
              "        0    vec3     color\n"
              "       12    bool     on\n"
              "       16    bvec3    channels[2]  array stride 16\n"
              "       48    uint     id\n"
              "    384    bool     all\n"
              "    388    uint     count\n");
}

TEST(Bools, AreNotAskedForWithoutUnsignedIntegers) {
    EXPECT_FALSE(may_hold_bools(*reflect_stage(compiled("uniform A { vec4 a; int b; };").spirv)));
}

struct Usage {
    const char* name;
    Stage stage;
    const char* declarations;
    const char* body;
    Names unused;
};

/// For messages of failed tests.
void PrintTo(const Usage& row, std::ostream* stream) {
    *stream << row.name;
}

const Usage usages[] = {
    {"everything_used",
     Stage::fragment,
     "uniform Fog { float near; float far; }; uniform sampler2D map; uniform float gain; in vec2 uv; out "
     "vec4 color;",
     "color = texture(map, uv) * gain * near;",
     {}},
    {"nothing_used",
     Stage::fragment,
     "uniform Fog { float near; } fog; uniform sampler2D map; uniform float gain; in vec2 uv; out vec4 "
     "color;",
     "",
     {"Fog", "color", "gain", "map", "uv"}},
    {"built_ins_do_not_count",
     Stage::vertex,
     "in vec3 position; out vec2 uv;",
     "gl_Position = vec4(1.0);",
     {"position", "uv"}},
    {"passed_to_a_function",
     Stage::fragment,
     "uniform sampler2D map; out vec4 color; vec4 look(sampler2D s) { return texture(s, vec2(0.5)); }",
     "color = look(map);",
     {}},
    {"only_in_a_function_never_called",
     Stage::fragment,
     "uniform float gain; out vec4 color; float twice() { return 2.0 * gain; }",
     "color = vec4(1.0);",
     {"gain"}},
    {"written_by_a_function",
     Stage::vertex,
     "out vec3 normal; void put(out vec3 n) { n = vec3(1.0); }",
     "put(normal); gl_Position = vec4(1.0);",
     {}},
    {"interpolated",
     Stage::fragment,
     "in vec2 uv; out vec2 color;",
     "color = interpolateAtCentroid(uv);",
     {}},
    {"stored_into_an_image",
     Stage::fragment,
     "layout(r32ui) uniform uimage2D counts;",
     "imageAtomicAdd(counts, ivec2(0), 1u);",
     {}},
    {"length_of_a_storage_array",
     Stage::fragment,
     "buffer Stream { float values[]; }; out vec4 color;",
     "color = vec4(values.length());",
     {}},
};

class Used : public ::testing::TestWithParam<Usage> {};

TEST_P(Used, OrNot) {
    const Usage& row = GetParam();
    const Result<Names> unused = unused_variables(compiled(row.declarations, row.body, row.stage).spirv);
    ASSERT_TRUE(unused);
    EXPECT_EQ(*unused, row.unused);
}

INSTANTIATE_TEST_SUITE_P(Variables, Used, ::testing::ValuesIn(usages),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
