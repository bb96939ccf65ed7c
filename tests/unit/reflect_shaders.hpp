// Shaders with every layout that reflection has to get right, for the witnesses to judge.
#pragma once

#include <ostream>
#include <string>

#include "reflect_compile.hpp"

namespace gobo::testing {

struct Shader {
    const char* name;
    Stage stage;
    const char* declarations;
    const char* body = "";
};

/// For messages of failed tests.
inline void PrintTo(const Shader& shader, std::ostream* stream) {
    *stream << shader.name;
}

/// std140 is stated for all blocks: the layout of others is the driver's choice (Mesa 22 packs them as
/// std430), while glslang gives them std140.
inline std::string source_of(const Shader& shader) {
    return std::string("#version 450\nlayout(std140) uniform;\n") + shader.declarations + "\nvoid main() {" +
           shader.body + "}\n";
}

/// Each declares uniform blocks that nothing reads.
inline constexpr Shader block_shaders[] = {
    {"scalars_and_vectors", Stage::fragment,
     "layout(std140, binding = 4) uniform Plain { float a; vec2 b; vec3 c; float d; ivec3 e; uvec4 f; int g; "
     "};"},
    {"vec3_then_float", Stage::fragment, "uniform Packed { vec3 color; float intensity; vec3 last; };"},
    {"ends_in_a_float", Stage::fragment,
     "layout(binding = 2) uniform Fog { vec3 color; float near; float far; };"},
    {"array_of_floats", Stage::fragment, "uniform Weights { float w[5]; float after; };"},
    {"array_of_structs", Stage::fragment,
     "struct Light { vec4 position; vec3 color; float range; vec2 cone; };\n"
     "layout(binding = 1) uniform Lights { int count; Light lights[7]; } scene;"},
    {"nested_structs", Stage::fragment,
     "struct Inner { vec3 a; float b; };\nstruct Middle { float x; Inner inner; mat3 basis; };\n"
     "struct Outer { Middle middle[2]; float tail; };\nuniform Nested { float head; Outer outer; float end; "
     "};"},
    {"nested_struct_last", Stage::fragment,
     "struct Inner { vec4 a; float b; };\nuniform Last { float head; Inner inner; };"},
    {"arrays_of_arrays", Stage::fragment, "uniform Grid { float g[3][2]; vec3 h[2][3][4]; };"},
    {"arrays_of_arrays_of_structs", Stage::fragment,
     "struct Cell { vec3 a; float w[2]; };\nuniform Cells { Cell cells[2][3]; float after; };"},
    {"matrices", Stage::fragment,
     "uniform Matrices { mat2 a; mat3 b; mat4 c; mat2x3 d; mat3x2 e; mat4x2 f; mat2x4 g; mat3x4 h; mat4x3 i; "
     "};"},
    {"row_major_matrices", Stage::fragment,
     "layout(row_major) uniform Rows { mat2 a; mat3 b; mat2x3 c; mat4x2 d; layout(column_major) mat2x3 e; "
     "};"},
    {"row_major_matrix_last", Stage::fragment, "uniform RowsLast { float a; layout(row_major) mat2x4 m; };"},
    {"arrays_of_matrices", Stage::fragment,
     "uniform Bones { mat3 a[4]; layout(row_major) mat4x3 b[2]; mat2 c[2][3]; float after; };"},
    {"row_major_struct", Stage::fragment,
     "struct Frame { mat3 basis; mat2x3 map[2]; };\n"
     "uniform Both { layout(row_major) Frame rows[2]; layout(column_major) Frame columns; };"},
    {"same_struct_in_two_layouts", Stage::fragment,
     "struct Item { float a; vec2 b; float c[2]; };\n"
     "layout(std140) uniform Loose { Item item; float end; };\n"
     "layout(std430, binding = 3) buffer Tight { Item items[2]; float last; };"},
    {"doubles", Stage::fragment,
     "uniform Doubles { double a; dvec2 b; dvec3 c; dvec4 d[2]; dmat2x3 e; float f; };"},
    {"explicit_offsets", Stage::fragment,
     "layout(std140) uniform Explicit { layout(offset = 32) vec4 a; layout(offset = 96, align = 32) float b; "
     "};"},
};

inline constexpr Shader other_shaders[] = {
    {"storage_without_size", Stage::fragment,
     "layout(std430, binding = 5) buffer Stream { uint n; vec4 rows[]; };"},
    {"array_of_blocks", Stage::fragment,
     "layout(binding = 6) uniform Material { vec4 color; } materials[3];"},
    {"samplers", Stage::fragment,
     "layout(binding = 0) uniform sampler2D a; uniform sampler1D b; uniform sampler3D c; uniform samplerCube "
     "d;\n"
     "uniform sampler2DRect e; uniform samplerBuffer f; uniform sampler2DMS g; uniform sampler2DMSArray h;\n"
     "uniform sampler1DArray i; uniform sampler2DArray j; uniform samplerCubeArray k;"},
    {"shadow_samplers", Stage::fragment,
     "uniform sampler2DShadow a; uniform sampler2DArrayShadow b; uniform samplerCubeShadow c;\n"
     "uniform samplerCubeArrayShadow d; uniform sampler1DShadow e; uniform sampler2DRectShadow f;"},
    {"integer_samplers", Stage::fragment,
     "uniform isampler2D a; uniform usampler3D b; uniform isamplerBuffer c; uniform usampler2DArray d;"},
    {"arrays_of_samplers", Stage::fragment,
     "layout(binding = 3) uniform sampler2D maps[4]; uniform sampler2DArrayShadow shadows[2][3];"},
    {"images", Stage::fragment,
     "layout(rgba8) uniform image2D a; layout(r32ui) uniform uimageBuffer b; layout(r32i) uniform "
     "iimage2DArray c;"},
    {"attributes", Stage::vertex,
     "layout(location = 0) in vec3 position; layout(location = 1) in mat4 model; layout(location = 5) in "
     "vec2 uv[2];\n"
     "layout(location = 7) in ivec4 bones; in mat2x3 unplaced;"},
    {"outputs", Stage::fragment,
     "layout(location = 0) out vec4 color; layout(location = 1) out vec4 more[2]; layout(location = 3) out "
     "uint id;"},
    {"varying_block", Stage::vertex, "out Surface { vec3 normal; flat int id; vec2 uv[2]; } surface;",
     "gl_Position = vec4(1.0);"},
    {"varying_struct", Stage::fragment,
     "struct Ray { vec3 origin; vec3 direction; };\nlayout(location = 2) in Ray rays[2]; in Ray single;"},
    {"built_ins_left_out", Stage::vertex, "out vec2 uv;",
     "gl_Position = vec4(gl_VertexID, gl_InstanceID, 0.0, 1.0); gl_PointSize = 1.0; uv = vec2(0.0);"},
};

}  // namespace gobo::testing
