// Structs and blocks that one stage hands to the next: their types, instances and locations.
#include <gtest/gtest.h>

#include "link_row.hpp"

namespace gobo {
namespace {

class BlockRules : public testing::TestWithParam<LinkRow> {};

TEST_P(BlockRules, AreToldAndAgreeWithMesa) {
    expect_verdicts(GetParam());
}

const LinkRow blocks[] = {
    {"instance_of_a_located_block_in_one_stage",
     "450",
     "layout(location = 1) out Surface { vec4 tint, tone; };\n"
     "void main() { tint = tone = gl_Position = vec4(0.0); }\n",
     "layout(location = 1) in Surface { vec4 tint, tone; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::older_refuses,
     {"'Surface.tint' is of an instance here, but of none in tiny.vert:2, and their block states locations"}},
    {"instance_of_a_block_in_one_stage",
     "450",
     "out Surface { vec4 tint; };\nvoid main() { tint = gl_Position = vec4(0.0); }\n",
     "in Surface { vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::links,
     {}},
    {"block_at_another_location_than_its_first_member",
     "450",
     "layout(location = 2) out Surface { layout(location = 0) vec4 tint; } o;\n"
     "void main() { o.tint = gl_Position = vec4(0.0); }\n",
     "layout(location = 2) in Surface { layout(location = 0) vec4 tint; } i;\nout vec4 c;\n"
     "void main() { c = i.tint; }\n",
     Mesa::older_refuses,
     {"tiny.frag:2: error: the block of 'Surface.tint' states one location, and its first member another"}},
    {"array_of_structs_of_other_precisions",
     "150",
     "struct Ray { vec3 from; vec3 to; };\nout Ray r[2];\n"
     "void main() { r[0].from = r[1].from = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "struct Ray { vec3 from; mediump vec3 to; };\nin Ray r[2];\nout vec4 c;\n"
     "void main() { c = r[1].from.xyzx; }\n",
     Mesa::refuses,
     {"tiny.frag:3: error: 'r[0].to' is mediump here, but without precision in tiny.vert:3: it belongs to "
      "the type of what holds it [default]\n    in Ray r[2];\n  help: declare that once, in a piece that "
      "both stages include"}},
    {"array_of_structs_of_other_precisions_that_nothing_writes",
     "450",
     "struct Ray { vec3 from; vec3 to; };\nout Ray r[2];\nvoid main() { gl_Position = vec4(0.0); }\n",
     "struct Ray { vec3 from; mediump vec3 to; };\nin Ray r[2];\nout vec4 c;\n"
     "void main() { c = r[1].from.xyzx; }\n",
     Mesa::refuses,
     {"'r[0].from', which the vertex stage declares in tiny.vert:3 and never writes",
      "'r[0].to' is mediump here, but without precision in tiny.vert:3"}},
    {"struct_of_other_precisions",
     "450",
     "struct Ray { vec3 from; vec3 to; };\nout Ray r;\n"
     "void main() { r.from = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "struct Ray { vec3 from; mediump vec3 to; };\nin Ray r;\nout vec4 c;\n"
     "void main() { c = r.from.xyzx; }\n",
     Mesa::links,
     {}},
    {"array_of_structs_by_a_default_precision",
     "450",
     "struct Ray { vec3 from; };\nout Ray r[2];\n"
     "void main() { r[0].from = r[1].from = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "precision mediump float;\nstruct Ray { vec3 from; };\nin Ray r[2];\nout vec4 c;\n"
     "void main() { c = r[1].from.xyzx; }\n",
     Mesa::links,
     {}},
    {"struct_of_other_precisions_in_a_block",
     "450",
     "struct End { vec3 at; };\nstruct Ray { vec3 from; End end; };\nout Rays { Ray r; } o;\n"
     "void main() { o.r.from = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "struct End { lowp vec3 at; };\nstruct Ray { vec3 from; End end; };\nin Rays { Ray r; } i;\n"
     "out vec4 c;\nvoid main() { c = i.r.from.xyzx; }\n",
     Mesa::refuses,
     {"'Rays.r.end.at' is lowp here, but without precision in tiny.vert:4"}},
    {"struct_of_other_default_precisions_in_a_block",
     "320 es",
     "struct Ray { vec3 from; };\nout Rays { Ray r; } o;\n"
     "void main() { o.r.from = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "precision mediump float;\nstruct Ray { vec3 from; };\nin Rays { Ray r; } i;\nout vec4 c;\n"
     "void main() { c = i.r.from.xyzx; }\n",
     Mesa::refuses,
     {"'Rays.r.from' is mediump here, but highp in tiny.vert:3"}},
    {"located_first_member_of_a_block_with_an_instance_in_one_stage",
     "450",
     "layout(location = 4) out Surface { layout(location = 0) vec2 uv; } o;\nvoid main() { gl_Position = "
     "vec4(0.0); }\n",
     "layout(location = 4) in Surface { layout(location = 0) vec2 uv; };\nout vec4 c;\n"
     "void main() { c = vec4(1.0); }\n",
     Mesa::older_refuses,
     {"'Surface.uv' is of no instance here, but of one in tiny.vert:2, and their block states locations"}},
    {"located_block_that_leaves_locations_free",
     "450",
     "layout(location = 0) out Surface { vec3 tint; layout(location = 5) float gloss; } o;\n"
     "void main() { o.tint = vec3(o.gloss = 1.0); gl_Position = vec4(0.0); }\n",
     "layout(location = 0) in Surface { vec3 tint; layout(location = 5) float gloss; } i;\nout vec4 c;\n"
     "void main() { c = i.tint.xyzx; }\n",
     Mesa::older_refuses,
     {"tiny.frag:2: error: the block 'Surface' states a location, and its members leave some free "
      "between them"}},
    {"located_members_that_leave_locations_free",
     "450",
     "out Surface { layout(location = 0) vec3 tint; layout(location = 5) float gloss; } o;\n"
     "void main() { o.tint = vec3(o.gloss = 1.0); gl_Position = vec4(0.0); }\n",
     "in Surface { layout(location = 0) vec3 tint; layout(location = 5) float gloss; } i;\nout vec4 c;\n"
     "void main() { c = i.tint.xyzx; }\n",
     Mesa::links,
     {}},
    {"located_members_of_blocks_of_two_names",
     "450",
     "out Surface { layout(location = 1) vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); "
     "}\n",
     "in Face { layout(location = 1) vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::refuses,
     {"'Face.tint' (location 1, 'Surface.tint' in the vertex stage) is a member of 'Face' here, but one of "
      "'Surface' in tiny.vert:2"}},
    {"array_of_blocks_with_a_location",
     "450",
     "layout(location = 2) out Surface { vec4 tint; } o[2];\nvoid main() { gl_Position = vec4(0.0); }\n",
     color,
     Mesa::refuses,
     {"tiny.vert:2: error: the array of blocks 'o' states a location"}},
    {"precision_in_an_array_of_blocks",
     "150",
     "out Surface { vec4 tint; } o[2];\nvoid main() { o[1].tint = gl_Position = vec4(0.0); }\n",
     "in Surface { mediump vec4 tint; } i[2];\nout vec4 c;\nvoid main() { c = i[1].tint; }\n",
     Mesa::refuses,
     {"'Surface[0].tint' is mediump here, but without precision in tiny.vert:2: it belongs to the type"}},
    {"precision_in_a_block",
     "150",
     "out Surface { vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); }\n",
     "in Surface { mediump vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::links,
     {}},
    {"flat_in_an_array_of_blocks",
     "450",
     "out Surface { vec4 tint; } o[2];\nvoid main() { o[1].tint = gl_Position = vec4(0.0); }\n",
     "in Surface { flat vec4 tint; } i[2];\nout vec4 c;\nvoid main() { c = i[1].tint; }\n",
     Mesa::refuses,
     {"'Surface[0].tint' is flat here, but smooth in tiny.vert:2: the members of an array of blocks must"}},
    {"flat_in_a_block",
     "450",
     "out Surface { vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); }\n",
     "in Surface { flat vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::links,
     {}},
    {"centroid_in_an_array_of_blocks_es",
     "320 es",
     "out Surface { vec4 tint; } o[2];\nvoid main() { o[1].tint = gl_Position = vec4(0.0); }\n",
     "in Surface { centroid vec4 tint; } i[2];\nout vec4 c;\nvoid main() { c = i[1].tint; }\n",
     Mesa::refuses,
     {"'Surface[0].tint' is centroid here, but not in tiny.vert:2: the members of a block must agree"}},
    {"sample_in_a_block_es",
     "320 es",
     "out Surface { vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); }\n",
     "in Surface { sample vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::links,
     {}},
    {"sample_of_a_variable_es",
     "320 es",
     "out vec4 tint;\nvoid main() { tint = gl_Position = vec4(0.0); }\n",
     "sample in vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"'tint' is sample here, but neither in tiny.vert:2"}},
    {"order_of_a_matrix_where_there_is_none",
     "330 core",
     "layout(std140) uniform Light { layout(row_major) vec4 tint; } l;\nvoid main() { gl_Position = l.tint; "
     "}\n",
     "layout(std140) uniform Light { layout(column_major) vec4 tint; } l;\nout vec4 c;\n"
     "void main() { c = l.tint; }\n",
     Mesa::links,
     {}},
    {"order_of_a_matrix",
     "330 core",
     "layout(std140) uniform Light { layout(row_major) mat4 turn; } l;\n"
     "void main() { gl_Position = l.turn[0]; }\n",
     "layout(std140) uniform Light { layout(column_major) mat4 turn; } l;\nout vec4 c;\n"
     "void main() { c = l.turn[0]; }\n",
     Mesa::refuses,
     {"the block 'Light' has 'mat4 turn' at offset 0 (of other members or strides) here"}},
    {"memory_of_an_image",
     "450",
     "layout(rgba8, binding = 0) uniform readonly image2D m;\n"
     "void main() { gl_Position = imageLoad(m, ivec2(0)); }\n",
     "layout(rgba8, binding = 0) uniform coherent image2D m;\nout vec4 c;\n"
     "void main() { c = imageLoad(m, ivec2(1)); }\n",
     Mesa::links,
     {"warning: images in the vertex stage: 1, OpenGL guarantees only 0 (MAX_VERTEX_IMAGE_UNIFORMS)"}},
    {"format_and_memory_of_an_image",
     "450",
     "layout(rgba8, binding = 0) uniform readonly image2D m;\n"
     "void main() { gl_Position = imageLoad(m, ivec2(0)); }\n",
     "layout(rgba16f, binding = 0) uniform coherent image2D m;\nout vec4 c;\n"
     "void main() { c = imageLoad(m, ivec2(1)); }\n",
     Mesa::refuses,
     {"'m' is of format rgba16f here, but of format rgba8 in tiny.vert:2"}},
    {"memory_of_an_image_es",
     "310 es",
     "layout(rgba8, binding = 0) uniform readonly highp image2D m;\n"
     "void main() { gl_Position = imageLoad(m, ivec2(0)); }\n",
     "layout(rgba8, binding = 0) uniform coherent readonly highp image2D m;\nout vec4 c;\n"
     "void main() { c = imageLoad(m, ivec2(1)); }\n",
     Mesa::is_lax,
     {"'layout( binding=0 rgba8) coherent readonly uniform' here"}},
    {"located_blocks_of_two_names_and_other_members",
     "450",
     "layout(location = 2) out Skin { vec4 tint; vec4 tone; } o;\n"
     "void main() { o.tint = o.tone = gl_Position = vec4(0.0); }\n",
     "layout(location = 2) in Surface { vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: the block 'Surface' has other members than 'Skin' in tiny.vert:2 at its "
      "location"}},
    {"located_blocks_of_two_names",
     "450",
     "layout(location = 2) out Skin { vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); }\n",
     "layout(location = 2) in Surface { vec4 tint; } i;\nout vec4 c;\nvoid main() { c = i.tint; }\n",
     Mesa::links,
     {}},
    {"component_0_in_one_stage",
     "450",
     "layout(location = 2) out vec4 tint;\nvoid main() { tint = gl_Position = vec4(0.0); }\n",
     "layout(location = 2, component = 0) in vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::links,
     {}},
    {"component_1_in_one_stage",
     "450",
     "layout(location = 2, component = 1) out vec2 uv;\nvoid main() { uv = vec2(0.0); gl_Position = "
     "vec4(0.0); }\n",
     "layout(location = 2) in vec2 uv;\nout vec4 c;\nvoid main() { c = uv.xyxy; }\n",
     Mesa::refuses,
     {"the fragment stage reads 'vec2 uv', which the vertex stage does not write"}},
    {"packed_array_of_blocks_that_one_stage_reads",
     "330 core",
     "layout(packed) uniform Light { vec4 tint; } lights[2];\nvoid main() { gl_Position = vec4(0.0); }\n",
     "layout(packed) uniform Light { vec4 tint; } lights[2];\nout vec4 c;\n"
     "void main() { c = lights[1].tint; }\n",
     Mesa::older_refuses,
     {"tiny.vert:2: warning: the uniform block 'Light' does not state std140",
      "tiny.frag:2: warning: the uniform block 'Light' does not state std140",
      "tiny.frag:2: error: the block 'Light' has layout packed and is read here, but is not in tiny.vert:2"}},
    {"packed_block_that_one_stage_reads",
     "330 core",
     "layout(packed) uniform Light { vec4 tint; } light;\nvoid main() { gl_Position = vec4(0.0); }\n",
     "layout(packed) uniform Light { vec4 tint; } light;\nout vec4 c;\nvoid main() { c = light.tint; }\n",
     Mesa::links,
     {"tiny.vert:2: warning: the uniform block 'Light' does not state std140",
      "tiny.frag:2: warning: the uniform block 'Light' does not state std140"}},
};

INSTANTIATE_TEST_SUITE_P(Blocks, BlockRules, testing::ValuesIn(blocks), name_of_row);

}  // namespace
}  // namespace gobo
