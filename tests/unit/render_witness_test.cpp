// Reflection against its second witness: what OpenGL says of the linked program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program_interface.hpp"
#include "reflect_compile.hpp"

namespace gobo {
namespace {

struct Row {
    const char* name;
    const char* declarations;
    const char* expression;  ///< a float that the fragment stage makes of the uniforms
};

constexpr const char* vertex_source = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 3) in mat2 shear;
layout(std140, binding = 5) uniform Camera { mat4 view; mat3 normals; float time; };
layout(location = 0) out vec3 normal;
void main() {
    normal = normals * position;
    gl_Position = view * vec4(shear * position.xy, position.z, 1.0);
}
)";

std::string fragment_source(const Row& row) {
    return std::string(
               "#version 450\nlayout(location = 0) in vec3 normal;\nlayout(location = 0) out vec4 color;\n") +
           row.declarations + "\nvoid main() { color = vec4(normal, " + row.expression + "); }\n";
}

constexpr Row rows[] = {
    {"scalars_and_vectors",
     "layout(std140, binding = 4) uniform Plain { float a; vec2 b; vec3 c; float d; ivec3 e; uvec4 f; int g; "
     "};",
     "a"},
    {"ends_in_a_float", "layout(std140, binding = 2) uniform Fog { vec3 tint; float near; float far; } fog;",
     "fog.far"},
    {"arrays_of_scalars", "layout(std140, binding = 1) uniform Weights { float w[5]; float after; } weights;",
     "weights.w[3]"},
    {"array_of_structs",
     "struct Light { vec4 position; vec3 tint; float range; vec2 cone; };\n"
     "layout(std140, binding = 1) uniform Lights { int count; Light lights[7]; } scene;",
     "scene.lights[scene.count].range"},
    {"nested_structs",
     "struct Inner { vec3 a; float b; };\nstruct Middle { float x; Inner inner[2]; mat3 basis; };\n"
     "layout(std140, binding = 1) uniform Nested { float head; Middle middle[2]; float end; } nested;",
     "nested.middle[1].inner[1].b"},
    {"arrays_of_arrays", "layout(std140, binding = 1) uniform Grid { float g[3][2]; vec3 h[2][3][4]; } grid;",
     "grid.g[2][1]"},
    {"arrays_of_arrays_of_structs",
     "struct Cell { vec3 a; float w[2]; };\n"
     "layout(std140, binding = 1) uniform Cells { Cell cells[2][3]; float after; } grid;",
     "grid.cells[1][2].w[1]"},
    {"matrices",
     "layout(std140, binding = 1) uniform Matrices { mat2 a; mat3 b; mat2x3 d; mat3x2 e; mat4x2 f; mat4x3 i; "
     "};",
     "a[0][0]"},
    {"row_major",
     "layout(std140, row_major, binding = 1) uniform Rows { mat3 b; mat2x3 c; layout(column_major) mat2x3 e; "
     "float tail; };",
     "tail"},
    {"arrays_of_matrices",
     "layout(std140, binding = 1) uniform Bones { mat3 a[4]; layout(row_major) mat4x3 b[2]; float after; };",
     "after"},
    {"row_major_struct",
     "struct Frame { mat3 basis; mat2x3 map[2]; };\n"
     "layout(std140, binding = 1) uniform Both { layout(row_major) Frame rows[2]; Frame columns; };",
     "rows[1].basis[2][0] + columns.basis[0][0]"},
    {"booleans",
     "struct Switch { bool on; bvec3 sides; };\n"
     "layout(std140, binding = 1) uniform Switches { bool all; Switch each[3]; uint mask; } s;",
     "s.all && s.each[1].sides.z ? 1.0 : 0.0"},
    {"plain_uniforms",
     "struct Light { vec4 position; float power[3]; };\n"
     "uniform Light lights[2];\nuniform mat3 basis;\nuniform bool on;\nuniform float weights[4];\nuniform "
     "int pick;",
     "lights[pick].power[pick] + basis[pick][0] + (on ? weights[pick] : 0.0)"},
    {"samplers",
     "layout(binding = 2) uniform sampler2D map;\nlayout(binding = 5) uniform sampler2DArrayShadow shadows;\n"
     "layout(binding = 7) uniform samplerCube sky[2];\nlayout(binding = 1) uniform usampler2D ids;",
     "texture(map, normal.xy).r + texture(shadows, normal.xyzz) + texture(sky[1], normal).r + "
     "float(texture(ids, normal.xy).r)"},
};

/// Both stages through glslang, and their interface.
Interface reflect(const Row& row) {
    return merge({testing::interface_of_stage(testing::Stage::vertex, vertex_source),
                  testing::interface_of_stage(testing::Stage::fragment, fragment_source(row))});
}

class Witness : public ::testing::TestWithParam<Row> {};

TEST_P(Witness, AgreesWithReflection) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const auto program = link_program(
        *context, {stage_text(StageKind::vertex, "witness.vert", vertex_source),
                   stage_text(StageKind::fragment, "witness.frag", fragment_source(GetParam()))});
    ASSERT_TRUE(program) << to_text(program.error().front());
    const ProgramInterface driver = interface_of_program(*context, *program);
    EXPECT_FALSE(driver.blocks.empty());
    EXPECT_THAT(differences(reflect(GetParam()), driver), ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Render, Witness, ::testing::ValuesIn(rows),
                         [](const auto& row) { return row.param.name; });

TEST(Witness, NamesEveryDifference) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const Row& row = rows[1];
    const auto program =
        link_program(*context, {stage_text(StageKind::vertex, "witness.vert", vertex_source),
                                stage_text(StageKind::fragment, "witness.frag", fragment_source(row))});
    ASSERT_TRUE(program) << to_text(program.error().front());
    Interface wrong = reflect(row);
    wrong.blocks[0].size = 160;              // Camera
    wrong.blocks[0].members[1].offset = 48;  // normals
    wrong.blocks[0].members[1].row_major = true;
    wrong.blocks[1].binding = 3;  // Fog
    wrong.blocks[1].stages = {"vertex"};
    wrong.blocks[1].members[0].type = "vec4";
    wrong.blocks[1].members[1].name = "close";
    wrong.uniforms.push_back({"gain", "float", -1, {}, {}, {"fragment"}});
    wrong.samplers.push_back({"map", "sampler2D", 0, {}, {"fragment"}});
    wrong.inputs[0].location = 7;
    EXPECT_THAT(
        differences(wrong, interface_of_program(*context, *program)),
        ::testing::ElementsAre("block Camera: size 160 reflected, 128 by the driver",
                               "block Fog: stages vertex reflected, fragment by the driver",
                               "block Fog: binding 3 reflected, 2 by the driver",
                               "member Camera.normals: offset 48 reflected, 64 by the driver",
                               "member Camera.normals: row major true reflected, false by the driver",
                               "member Fog.tint: type vec4 reflected, vec3 by the driver",
                               "member Fog.close: unknown to the driver", "member Fog.near: not reflected",
                               "uniform gain: unused", "sampler map: unused",
                               "input position: location 7 reflected, 0 by the driver"));
}

}  // namespace
}  // namespace gobo
