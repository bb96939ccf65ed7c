// Locations, bindings, texture units and offsets that are shared, and the limits of a device.
#include <gtest/gtest.h>

#include "link_row.hpp"

namespace gobo {
namespace {

class PlaceRules : public testing::TestWithParam<LinkRow> {};

TEST_P(PlaceRules, AreToldAndAgreeWithMesa) {
    expect_verdicts(GetParam());
}

const LinkRow places[] = {
    {"blocks_at_one_binding",
     "450",
     "layout(std140, binding = 0) uniform Camera { mat4 m; } camera;\nvoid main() { gl_Position = "
     "camera.m[0]; }\n",
     "layout(std140, binding = 0) uniform Light { vec4 tint; } light;\nout vec4 c;\nvoid main() { c = "
     "light.tint; }\n",
     Mesa::links,
     {"tiny.frag:2: warning: the blocks 'Light' and 'Camera' (tiny.vert:2) share binding 0"}},
    {"block_on_an_element",
     "450",
     plain,
     "layout(std140, binding = 1) uniform Lamp { vec4 tint; } lamps[3];\n"
     "layout(std140, binding = 2) uniform Sky { vec4 tint; } sky;\nout vec4 c;\n"
     "void main() { c = lamps[1].tint + sky.tint; }\n",
     Mesa::links,
     {"tiny.frag:3: warning: the blocks 'Sky' and 'Lamp[1]' (tiny.frag:2) share binding 2"}},
    {"attribute_behind_the_start_of_a_matrix",
     "330 core",
     "layout(location = 0) in mat4 m;\nlayout(location = 2) in vec4 q;\nvoid main() { gl_Position = m * q; "
     "}\n",
     color,
     Mesa::links,
     {"tiny.vert:3: warning: the attributes 'vec4 q' and 'mat4 m' (tiny.vert:2) share location 2: OpenGL "
      "takes "
      "it only where no path reads both"}},
    {"two_attributes_of_one_location",
     "450",
     "layout(location = 1) in vec4 p;\nlayout(location = 1) in vec4 q;\nvoid main() { gl_Position = p + q; "
     "}\n",
     color,
     Mesa::links,
     {"tiny.vert:3: warning: the attributes 'vec4 q' and 'vec4 p' (tiny.vert:2) share location 1"}},
    {"attributes_that_are_apart",
     "450",
     "layout(location = 0) in mat3 m;\nlayout(location = 3) in vec2 p;\n"
     "layout(location = 3, component = 2) in vec2 q;\nlayout(location = 1) in vec4 unread;\n"
     "void main() { gl_Position = vec4(m[2], 1.0) + vec4(p, q); }\n",
     color,
     Mesa::links,
     {}},
    {"sampler_on_an_element",
     "450",
     plain,
     "layout(binding = 0) uniform sampler2D maps[4];\nlayout(binding = 2) uniform sampler2D mask;\nout vec4 "
     "c;\n"
     "void main() { c = texture(maps[3], vec2(0.0)) + texture(mask, vec2(0.0)); }\n",
     Mesa::links,
     {"'sampler2D mask' and 'sampler2D maps' (tiny.frag:2) share texture unit 2"}},
    {"two_types_on_one_unit",
     "450",
     plain,
     "layout(binding = 1) uniform sampler2D map;\nlayout(binding = 1) uniform samplerCube sky;\nout vec4 c;\n"
     "void main() { c = texture(map, vec2(0.0)) + texture(sky, vec3(1.0)); }\n",
     Mesa::is_lax,
     {"share texture unit 1: OpenGL refuses to draw (INVALID_OPERATION)"}},
    {"units_of_an_array_without_a_size",
     "450",
     plain,
     "layout(binding = 0) uniform sampler2D maps[];\nout vec4 c;\nvoid main() { c = texture(maps[1], "
     "vec2(0.0)); }\n",
     Mesa::refuses,
     {"warning: '[]' : assuming binding count of one",
      "tiny.frag:2: error: the array 'maps' states binding 0 and no size"}},
    {"unread_on_one_unit",
     "450",
     plain,
     "layout(binding = 1) uniform sampler2D map;\nlayout(binding = 1) uniform samplerCube sky;\nout vec4 c;\n"
     "void main() { c = texture(map, vec2(0.0)); }\n",
     Mesa::links,
     {}},
    {"counters_at_one_offset",
     "450",
     plain,
     "layout(binding = 0, offset = 4) uniform atomic_uint hits;\n"
     "layout(binding = 0) uniform atomic_uint misses;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(hits) + atomicCounter(misses)); }\n",
     Mesa::links,
     {}},
    {"counters_of_two_stages_at_one_offset",
     "450",
     "layout(binding = 0, offset = 0) uniform atomic_uint hits[2];\n"
     "void main() { gl_Position = vec4(atomicCounter(hits[1])); }\n",
     "layout(binding = 0, offset = 4) uniform atomic_uint misses;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(misses)); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: the atomic counters 'misses' and 'hits' (tiny.vert:2) share offset 4 of binding "
      "0"}},
    {"unread_counter_at_one_offset",
     "450",
     plain,
     "layout(binding = 0, offset = 0) uniform atomic_uint hits;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(hits)); }\n",
     Mesa::links,
     {}},
    {"offsets_of_a_counter",
     "450",
     "layout(binding = 0, offset = 0) uniform atomic_uint hits;\nvoid main() { gl_Position = "
     "vec4(atomicCounter(hits)); }\n",
     "layout(binding = 0, offset = 4) uniform atomic_uint hits;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(hits)); }\n",
     Mesa::refuses,
     {"'hits' is at offset 4 here, but at 0 in tiny.vert:2"}},
    {"room_for_a_matrix",
     "450",
     "layout(location = 3) in vec4 a;\nlayout(location = 8) in vec4 b;\nin vec4 z;\nin mat4 m;\nin mat4 n;\n"
     "in mat3 k;\nvoid main() { gl_Position = a + b + z + m[0] + n[0] + k[0].xyzx; }\n",
     color,
     Mesa::links,
     {}},
    {"no_room_for_a_matrix",
     "330 core",
     "layout(location = 3) in vec4 a;\nlayout(location = 7) in vec4 b;\nlayout(location = 11) in vec4 c;\n"
     "layout(location = 15) in vec4 d;\nin mat4 m;\nvoid main() { gl_Position = a + b + c + d + m[0]; }\n",
     color,
     Mesa::refuses,
     {"tiny.vert:6: error: the vertex attribute 'm' takes 4 locations in a row, and no 4 in a row of the 16 "
      "that "
      "OpenGL guarantees are free (MAX_VERTEX_ATTRIBS)"}},
    {"no_room_for_an_unread_matrix",
     "330 core",
     "layout(location = 3) in vec4 a;\nlayout(location = 7) in vec4 b;\nlayout(location = 11) in vec4 c;\n"
     "layout(location = 15) in vec4 d;\nin mat4 m;\nvoid main() { gl_Position = a + b + c + d; }\n",
     color,
     Mesa::links,
     {}},
    {"no_room_for_an_array_of_outputs",
     "450",
     plain,
     "layout(location = 1) out vec4 a;\nlayout(location = 3) out vec4 b;\nlayout(location = 5) out vec4 c;\n"
     "layout(location = 7) out vec4 d;\nout vec4 m[2];\n"
     "void main() { a = b = c = d = m[0] = m[1] = vec4(1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:6: error: the fragment output 'm' takes 2 locations in a row, and no 2 in a row of the 8"}},
    {"locations_of_a_sampler_and_a_uniform",
     "450",
     "layout(location = 1) uniform sampler2D maps[3];\nvoid main() { gl_Position = texture(maps[0], "
     "vec2(0.0)); }\n",
     "layout(location = 3) uniform vec4 tone;\nout vec4 c;\nvoid main() { c = tone; }\n",
     Mesa::refuses,
     {"the uniforms 'tone' and 'maps' (tiny.vert:2) share location 3"}},
};

const LinkRow limits[] = {
    {"varying_location_14",
     "450",
     "layout(location = 14) out vec4 s;\nvoid main() { s = vec4(1.0); gl_Position = s; }\n",
     "layout(location = 14) in vec4 s;\nout vec4 c;\nvoid main() { c = s; }\n",
     Mesa::links,
     {}},
    {"varying_location_20",
     "450",
     "layout(location = 20) out vec4 s;\nvoid main() { s = vec4(1.0); gl_Position = s; }\n",
     "layout(location = 20) in vec4 s;\nout vec4 c;\nvoid main() { c = s; }\n",
     Mesa::is_lax,
     {"tiny.vert:2: error: locations of varyings up to the last of 's': 21, OpenGL guarantees only 15"}},
    {"attributes_of_matrices_located",
     "450",
     "layout(location = 0) in mat4 a;\nlayout(location = 13) in mat4 b;\nvoid main() { gl_Position = a[0] + "
     "b[3]; }\n",
     color,
     Mesa::refuses,
     {"tiny.vert:3: error: vertex attribute locations up to the last of 'b': 17, OpenGL guarantees only 16"}},
    {"attributes_of_matrices",
     "330 core",
     "in mat4 a, b, d, e, f;\nvoid main() { gl_Position = a[0] + b[0] + d[0] + e[0] + f[3]; }\n",
     color,
     Mesa::refuses,
     {"vertex attribute locations: 20, OpenGL guarantees only 16 (MAX_VERTEX_ATTRIBS)"}},
    {"unread_attributes",
     "330 core",
     "in mat4 a, b, d, e, f;\nvoid main() { gl_Position = a[0]; }\n",
     color,
     Mesa::links,
     {}},
    {"output_location_8",
     "450",
     plain,
     "layout(location = 0) out vec4 c;\nlayout(location = 8) out vec4 d;\nvoid main() { c = d = vec4(1.0); "
     "}\n",
     Mesa::refuses,
     {"tiny.frag:3: error: fragment output locations up to the last of 'd': 9"}},
    {"plain_uniforms",
     "450",
     plain,
     "uniform vec4 big[257];\nout vec4 c;\nvoid main() { c = big[256]; }\n",
     Mesa::links,
     {"tiny.frag:2: warning: components of plain uniforms in the fragment stage: 1028, OpenGL guarantees "
      "only "
      "1024"}},
    {"unread_uniforms",
     "450",
     plain,
     "uniform vec4 big[2000];\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"unread_samplers",
     "330 core",
     plain,
     "uniform sampler2D maps[30];\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"varyings_packed_es300",
     "300 es",
     "out vec2 a, b, d, e, f, g, h, i, j, k, l, m, n, o, p, q;\n"
     "void main() { a = b = d = e = f = g = h = i = j = k = l = m = n = o = p = q = vec2(1.0); "
     "gl_Position = vec4(0.0); }\n",
     "in vec2 a, b, d, e, f, g, h, i, j, k, l, m, n, o, p, q;\nout vec4 c;\n"
     "void main() { c = (a + b + d + e + f + g + h + i + j + k + l + m + n + o + p + q).xyxy; }\n",
     Mesa::links,
     {}},
    {"varyings_beyond_rows_es300",
     "300 es",
     "out vec3 v[16];\nvoid main() { for (int i = 0; i < 16; ++i) v[i] = vec3(1.0); gl_Position = vec4(0.0); "
     "}\n",
     "in vec3 v[16];\nout vec4 c;\nvoid main() { c = v[15].xyzx; }\n",
     Mesa::is_lax,
     {"varying vectors: 16, OpenGL guarantees only 15 (MAX_VARYING_VECTORS)"}},
    {"storage_blocks_16",
     "450",
     plain,
     "layout(std430, binding = 0) buffer A { float x; } a[8];\n"
     "layout(std430, binding = 0) buffer B { float x; } b[8];\nout vec4 c;\n"
     "void main() { c = vec4(a[0].x + a[1].x + a[2].x + a[3].x + a[4].x + a[5].x + a[6].x + a[7].x\n"
     "    + b[0].x + b[1].x + b[2].x + b[3].x + b[4].x + b[5].x + b[6].x + b[7].x); }\n",
     Mesa::links,
     {"share binding 0", "warning: storage blocks in the fragment stage: 16, OpenGL guarantees only 8"}},
    {"storage_blocks_17",
     "450",
     plain,
     "layout(std430, binding = 0) buffer A { float x; } a[8];\n"
     "layout(std430, binding = 0) buffer B { float x; } b[8];\n"
     "layout(std430, binding = 0) buffer C { float x; } d;\nout vec4 c;\n"
     "void main() { c = vec4(a[0].x + a[1].x + a[2].x + a[3].x + a[4].x + a[5].x + a[6].x + a[7].x\n"
     "    + b[0].x + b[1].x + b[2].x + b[3].x + b[4].x + b[5].x + b[6].x + b[7].x + d.x); }\n",
     Mesa::refuses,
     {"share binding 0", "share binding 0", "share binding 0",
      "error: storage blocks in the fragment stage: 17, OpenGL guarantees only 8 "
      "(MAX_FRAGMENT_SHADER_STORAGE_BLOCKS)"}},
};

INSTANTIATE_TEST_SUITE_P(Places, PlaceRules, testing::ValuesIn(places), name_of_row);
INSTANTIATE_TEST_SUITE_P(Limits, PlaceRules, testing::ValuesIn(limits), name_of_row);

}  // namespace
}  // namespace gobo
