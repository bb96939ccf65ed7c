// Programs of other stages than the vertex and the fragment stage: what gobo says of them, and whether Mesa
// links them.
#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/read_family.hpp"
#include "lab/render/render.hpp"
#include "small_families.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using testing::HasSubstr;

/// The text of a stage without its #version.
struct StageRow {
    StageKind kind;
    const char* text;
};

struct Row {
    const char* name;
    const char* version;
    std::vector<StageRow> stages;
    bool is_right;
    std::vector<const char*> messages = {};  ///< each that gobo gives, in part
    bool mesa_is_lax = false;  ///< links what GLSL 4.50, 4.3.4, refuses: an input that nothing writes
    bool ends_mesa = false;    ///< of 25.0, which crashes
};

void PrintTo(const Row& row, std::ostream* stream) {
    *stream << row.name;
}

class Stages : public testing::TestWithParam<Row> {};

TEST_P(Stages, AreCheckedAsMesaDoes) {
    const Row& row = GetParam();
    std::map<std::string, std::string, std::less<>> files;
    std::string toml = "name = \"tiny\"\n";
    for (const auto& [kind, text] : row.stages) {
        const std::string file = fmt::format("tiny.{}", names_of(kind).infix);
        toml += fmt::format("{} = \"{}\"\n", name_of(kind), file);
        files[file] = fmt::format("#version {}\n{}", row.version, text);
    }
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Result<Family> family = read_family(toml, "tiny.toml", {});
    ASSERT_TRUE(family) << first_text(family.error());
    const Composition composition = compose(*family, {{}}, search, Dialect::own).value();
    const Diagnostics found = validate(*family, composition, {}).diagnostics;
    ASSERT_EQ(found.size(), row.messages.size()) << to_text(found);
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_THAT(to_text(found[i]), HasSubstr(row.messages[i])) << to_text(found);
    EXPECT_EQ(exit_status(found) == 0, row.is_right) << to_text(found);

    if (row.ends_mesa) return;
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << first_text(context.error());
    const Result<Program> program =
        link_program(*context, stages_of(composition, composition.permutations.front()));
    EXPECT_EQ(program.has_value(), row.is_right || row.mesa_is_lax)
        << (program ? "it links" : first_text(program.error()));
}

constexpr StageKind kVertex = StageKind::vertex, kControl = StageKind::tess_control,
                    kEvaluation = StageKind::tess_evaluation, kGeometry = StageKind::geometry,
                    kFragment = StageKind::fragment, kCompute = StageKind::compute;

constexpr const char* normal_out = "out vec3 n;\nvoid main() { n = vec3(1.0); gl_Position = vec4(0.0); }\n";
constexpr const char* normal_in = "in vec3 m;\nout vec4 c;\nvoid main() { c = vec4(m, 1.0); }\n";
constexpr const char* white = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";
constexpr const char* plain = "void main() { gl_Position = vec4(0.0); }\n";

/// A geometry stage that declares `inputs` and hands `value` on as m.
std::string geometry(const std::string& inputs, const std::string& value) {
    return fmt::format(
        "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\n{}\nout vec3 m;\n"
        "void main() {{\n    for (int i = 0; i < 3; ++i) {{\n        m = {};\n"
        "        gl_Position = gl_in[i].gl_Position;\n        EmitVertex();\n    }}\n}}\n",
        inputs, value);
}
const std::string passes_on = geometry("in vec3 n[];", "n[i]");
const std::string sized = geometry("in vec3 n[3];", "n[i]");
const std::string of_four = geometry("in vec4 n[];", "n[i].xyz");
const std::string flat_in = geometry("flat in vec3 n[];", "n[i]");
const std::string unwritten = geometry("in vec3 k[];", "k[i]");
const std::string of_block = geometry("in Data { vec3 n; vec2 t; } data[];", "data[i].n");
const std::string of_other_block = geometry("in Data { vec3 n; vec3 t; } data[];", "data[i].t");
const std::string with_tint = geometry("in vec3 n[];\nuniform vec4 tint;", "n[i] * tint.rgb");
const std::string without_place =
    "layout(triangles) in;\nlayout(points, max_vertices = 1) out;\nvoid main() { EmitVertex(); }\n";
const std::string without_primitive =
    "layout(points, max_vertices = 1) out;\nvoid main() { gl_Position = vec4(0.0); EmitVertex(); }\n";
const std::string of_stream_1 =
    "layout(points) in;\nlayout(points, max_vertices = 1) out;\nlayout(stream = 1) out vec3 m;\n"
    "void main() { gl_Position = vec4(0.0); m = vec3(1.0); EmitStreamVertex(1); }\n";
constexpr const char* block_out =
    "out Data { vec3 n; vec2 t; } data;\n"
    "void main() { data.n = vec3(1.0); data.t = vec2(1.0); gl_Position = vec4(0.0); }\n";

const Row with_geometry[] = {
    {"array_of_inputs",
     "330 core",
     {{kVertex, normal_out}, {kGeometry, passes_on.c_str()}, {kFragment, normal_in}},
     true},
    {"array_of_inputs_sized",
     "150",
     {{kVertex, normal_out}, {kGeometry, sized.c_str()}, {kFragment, normal_in}},
     true},
    {"input_of_another_type",
     "330 core",
     {{kVertex, normal_out}, {kGeometry, of_four.c_str()}, {kFragment, normal_in}},
     false,
     {"tiny.geom:4: error: 'n' is vec4 here, but vec3 in tiny.vert:2"}},
    {"input_of_another_interpolation",
     "330 core",
     {{kVertex, normal_out}, {kGeometry, flat_in.c_str()}, {kFragment, normal_in}},
     false,
     {"tiny.geom:4: error: 'n' is flat here, but smooth in tiny.vert:2"}},
    {"output_of_another_stream",
     "450",
     {{kVertex, plain}, {kGeometry, of_stream_1.c_str()}, {kFragment, normal_in}},
     false,
     {"tiny.frag:2: error: the fragment stage reads 'm', which belongs to stream 1 of the geometry stage"}},
    {"unread_output_of_another_stream",
     "450",
     {{kVertex, plain}, {kGeometry, of_stream_1.c_str()}, {kFragment, white}},
     true},
    {"input_that_nothing_writes",
     "330 core",
     {{kVertex, normal_out}, {kGeometry, unwritten.c_str()}, {kFragment, normal_in}},
     false,
     {"tiny.geom:4: error: the geometry stage reads 'vec3 k', which the vertex stage does not write"},
     true},
    {"varying_that_does_not_pass",
     "330 core",
     {{kVertex, "out vec3 m;\nvoid main() { m = vec3(1.0); gl_Position = vec4(0.0); }\n"},
      {kGeometry,
       "layout(points) in;\nlayout(points, max_vertices = 1) out;\n"
       "void main() { gl_Position = gl_in[0].gl_Position; EmitVertex(); }\n"},
      {kFragment, normal_in}},
     false,
     {"tiny.frag:2: error: the fragment stage reads 'vec3 m', which the geometry stage does not write"},
     true},
    {"array_of_blocks",
     "330 core",
     {{kVertex, block_out}, {kGeometry, of_block.c_str()}, {kFragment, normal_in}},
     true},
    {"array_of_other_blocks",
     "330 core",
     {{kVertex, block_out}, {kGeometry, of_other_block.c_str()}, {kFragment, normal_in}},
     false,
     {"tiny.geom:4: error: 'Data.t' is vec3 here, but vec2 in tiny.vert:2"}},
    {"uniform_of_another_type",
     "330 core",
     {{kVertex, normal_out},
      {kGeometry, with_tint.c_str()},
      {kFragment, "in vec3 m;\nuniform vec3 tint;\nout vec4 c;\nvoid main() { c = vec4(m * tint, 1.0); }\n"}},
     false,
     {"tiny.frag:3: error: 'tint' is vec3 here, but vec4 in tiny.geom:5"}},
    {"no_input_primitive",
     "330 core",
     {{kVertex, plain}, {kGeometry, without_primitive.c_str()}, {kFragment, white}},
     false,
     {"At least one shader must specify an input layout primitive"}},
    {"no_position",
     "330 core",
     {{kVertex, plain}, {kGeometry, without_place.c_str()}, {kFragment, white}},
     true,
     {"tiny.geom: warning: the geometry stage never writes gl_Position"}},
    {"position_written_by_the_geometry_stage_alone",
     "330 core",
     {{kVertex, "void main() {}\n"},
      {kGeometry,
       "layout(points) in;\nlayout(points, max_vertices = 1) out;\n"
       "void main() { gl_Position = vec4(0.0); EmitVertex(); }\n"},
      {kFragment, white}},
     true},
};

constexpr const char* control =
    "layout(vertices = 3) out;\nin vec3 n[];\nout vec3 k[];\npatch out vec2 p;\n"
    "void main() { k[gl_InvocationID] = n[gl_InvocationID]; p = vec2(1.0);\n"
    "gl_TessLevelOuter[0] = gl_TessLevelOuter[1] = gl_TessLevelOuter[2] = gl_TessLevelInner[0] = 2.0;\n"
    "gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position; }\n";
constexpr const char* evaluation =
    "layout(triangles) in;\nin vec3 k[];\npatch in vec2 p;\nout vec3 m;\n"
    "void main() { m = k[0] + p.x; gl_Position = gl_in[0].gl_Position; }\n";

const Row with_tessellation[] = {
    {"control_and_evaluation",
     "400 core",
     {{kVertex, normal_out}, {kControl, control}, {kEvaluation, evaluation}, {kFragment, normal_in}},
     true},
    {"evaluation_alone",
     "410 core",
     {{kVertex, normal_out},
      {kEvaluation,
       "layout(quads) in;\nin vec3 n[];\nout vec3 m;\n"
       "void main() { m = n[0]; gl_Position = vec4(gl_TessCoord, 1.0); }\n"},
      {kFragment, normal_in}},
     true},
    {"all_stages",
     "430 core",
     {{kVertex, normal_out},
      {kControl, control},
      {kEvaluation,
       "layout(triangles) in;\nin vec3 k[];\npatch in vec2 p;\nout vec3 n;\n"
       "void main() { n = k[0] + p.x; gl_Position = gl_in[0].gl_Position; }\n"},
      {kGeometry, passes_on.c_str()},
      {kFragment, normal_in}},
     true},
    {"patch_meets_an_array",
     "400 core",
     {{kVertex, normal_out},
      {kControl, control},
      {kEvaluation,
       "layout(triangles) in;\nin vec3 k[];\nin vec2 p[];\nout vec3 m;\n"
       "void main() { m = k[0] + p[0].x; gl_Position = gl_in[0].gl_Position; }\n"},
      {kFragment, normal_in}},
     false,
     {"tiny.tese:4: error: 'p' is not patch here, but patch in tiny.tesc:5"}},
    {"no_vertices_stated",
     "400 core",
     {{kVertex, normal_out},
      {kControl, "void main() { gl_TessLevelInner[0] = 2.0; }\n"},
      {kEvaluation, "layout(triangles) in;\nvoid main() { gl_Position = gl_in[0].gl_Position; }\n"},
      {kFragment, white}},
     false,
     {"At least one shader must specify an output layout(vertices=...)"}},
    {"version_without_tessellation",
     "330 core",
     {{kVertex, normal_out}, {kControl, control}, {kEvaluation, evaluation}, {kFragment, normal_in}},
     false,
     {"tiny.tesc: error: a tess_control stage needs GLSL 400, but this is 330",
      "tiny.tese: error: a tess_evaluation stage needs GLSL 400, but this is 330"}},
};

const Row with_compute[] = {
    {"alone",
     "430 core",
     {{kCompute,
       "layout(local_size_x = 8) in;\nlayout(std430, binding = 0) buffer B { float x[]; };\n"
       "void main() { x[gl_GlobalInvocationID.x] = 1.0; }\n"}},
     true},
    {"of_opengl_es",
     "310 es",
     {{kCompute,
       "precision highp float;\nlayout(local_size_x = 8, local_size_y = 2) in;\n"
       "layout(std430, binding = 0) buffer B { float x[]; };\n"
       "void main() { x[gl_GlobalInvocationID.x] = 1.0; }\n"}},
     true},
    {"size_of_groups_not_stated",
     "430 core",
     {{kCompute, "layout(std430, binding = 0) buffer B { float x[]; };\nvoid main() { x[0] = 1.0; }\n"}},
     false,
     {"tiny.comp: error: the compute stage does not state the size of its work groups"}},
    {"groups_too_large",
     "430 core",
     {{kCompute,
       "layout(local_size_x = 2048) in;\nlayout(std430, binding = 0) buffer B { float x[]; };\n"
       "void main() { x[0] = 1.0; }\n"}},
     false,
     {"tiny.comp:2: error: 'local_size' : too large"}},
    {"local_sizes_that_disagree",
     "430 core",
     {{kCompute,
       "layout(local_size_x = 8) in;\nlayout(local_size_y = 2) in;\n"
       "layout(std430, binding = 0) buffer B { float x[]; };\nvoid main() { x[0] = 1.0; }\n"}},
     false,
     {"tiny.comp:3: error: the local size is 1 x 2 x 1 here, but 8 x 1 x 1 above"}},
    {"local_sizes_that_agree",
     "430 core",
     {{kCompute,
       "layout(local_size_x = 8) in;\nlayout(local_size_y = 1, local_size_x = 8) in;\n"
       "layout(std430, binding = 0) buffer B { float x[]; };\nvoid main() { x[0] = 1.0; }\n"}},
     true},
    {"local_size_by_a_macro",
     "430 core",
     {{kCompute,
       "#define SIZE 8\nlayout(local_size_x = SIZE) in;\nlayout(local_size_x = 8) in;\n"
       "layout(std430, binding = 0) buffer B { float x[]; };\nvoid main() { x[0] = 1.0; }\n"}},
     true},
    {"version_without_compute",
     "330 core",
     {{kCompute, "void main() {}\n"}},
     false,
     {"tiny.comp: error: a compute stage needs GLSL 430, but this is 330"},
     false,
     true},
};

struct PictureRow {
    const char* name;
    std::vector<StageRow> stages;
};

constexpr const char* flat_plane =
    "in vec3 position;\nvoid main() { gl_Position = vec4(position.xz, 0.0, 1.0); gl_PointSize = 4.0; }\n";
constexpr const char* of_triangles =
    "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\nvoid main() {\n"
    "for (int i = 0; i < 3; ++i) { gl_Position = gl_in[i].gl_Position; EmitVertex(); }\n}\n";
constexpr const char* of_points =
    "layout(points) in;\nlayout(points, max_vertices = 1) out;\n"
    "void main() { gl_Position = gl_in[0].gl_Position; EmitVertex(); }\n";
const std::string points_out =
    " in;\nlayout(points, max_vertices = 6) out;\nvoid main() {\n"
    "for (int i = 0; i < gl_in.length(); ++i) { gl_Position = gl_in[i].gl_Position; EmitVertex(); }\n}\n";
const std::string of_lines = "layout(lines)" + points_out;
const std::string of_lines_and_neighbours = "layout(lines_adjacency)" + points_out;
const std::string of_triangles_and_neighbours = "layout(triangles_adjacency)" + points_out;
constexpr const char* triangles =
    "layout(triangles) in;\nvoid main() { gl_Position = gl_in[0].gl_Position * gl_TessCoord.x +\n"
    "gl_in[1].gl_Position * gl_TessCoord.y + gl_in[2].gl_Position * gl_TessCoord.z; }\n";
constexpr const char* quads =
    "layout(quads) in;\nvoid main() { gl_Position = mix(\n"
    "mix(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_TessCoord.x),\n"
    "mix(gl_in[3].gl_Position, gl_in[2].gl_Position, gl_TessCoord.x), gl_TessCoord.y); }\n";
/// Right only where a patch has its sixteen corners.
constexpr const char* sixteen =
    "layout(vertices = 16) out;\nvoid main() {\n"
    "gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position *\n"
    "    float(gl_PatchVerticesIn == 16);\n"
    "gl_TessLevelOuter = float[4](1.0, 1.0, 1.0, 1.0);\ngl_TessLevelInner = float[2](1.0, 1.0);\n}\n";

TEST(Pictures, AreDrawnThroughStagesBetween) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << first_text(context.error());
    const PictureRow rows[] = {
        {"triangles", {{kVertex, flat_plane}, {kGeometry, of_triangles}, {kFragment, white}}},
        {"points", {{kVertex, flat_plane}, {kGeometry, of_points}, {kFragment, white}}},
        {"lines", {{kVertex, flat_plane}, {kGeometry, of_lines.c_str()}, {kFragment, white}}},
        {"lines_adjacency",
         {{kVertex, flat_plane}, {kGeometry, of_lines_and_neighbours.c_str()}, {kFragment, white}}},
        {"triangles_adjacency",
         {{kVertex, flat_plane}, {kGeometry, of_triangles_and_neighbours.c_str()}, {kFragment, white}}},
        {"patches_of_three", {{kVertex, flat_plane}, {kEvaluation, triangles}, {kFragment, white}}},
        {"patches_of_four", {{kVertex, flat_plane}, {kEvaluation, quads}, {kFragment, white}}},
        {"patches_of_sixteen",
         {{kVertex, flat_plane}, {kControl, sixteen}, {kEvaluation, quads}, {kFragment, white}}},
    };
    for (const PictureRow& row : rows) {
        SCOPED_TRACE(row.name);
        std::vector<StageText> stages;
        Interface interface;
        for (const auto& [kind, text] : row.stages) {
            stages.push_back(
                stage_text(kind, std::string(name_of(kind)), std::string("#version 430 core\n") + text));
            interface.stages.emplace_back(name_of(kind));
        }
        interface.inputs = {{"position", "vec3", -1, {}}};
        interface.outputs = {{"color", "vec4", -1, {}}};
        View view;
        view.width = view.height = 16;
        std::vector<Object> objects(1);
        objects.front().mesh = make_plane(1, 4);
        const Result<Picture> picture = render_permutation(*context, stages, interface, objects, {}, view);
        ASSERT_TRUE(picture) << first_text(picture.error());
        EXPECT_EQ(std::ranges::max(picture->color.values), 1.0F);
        EXPECT_GT(std::ranges::count(picture->color.values, 1.0F), 16 * 16 + 20) << "beside alpha";
    }
}

/// A vertex and a fragment stage of which one has a subroutine uniform `shade`, that is `red` or `blue`.
struct SubroutineRow {
    const char* name;
    const char* vertex;
    const char* fragment;
    std::vector<std::string> kept;  ///< what both keys' texts hold
};

/// A choice between the functions of a subroutine uniform, and Mesa's verdict on each.
class SubroutineUniforms : public testing::TestWithParam<SubroutineRow> {};

TEST_P(SubroutineUniforms, BecomeChoices) {
    const MemoryFileSystem disk(std::map<std::string, std::string, std::less<>>{
        {"tiny.vert", std::string("#version 430 core\n") + GetParam().vertex},
        {"tiny.frag",
         std::string("#version 430 core\nsubroutine vec4 Shade(float x);\n"
                     "subroutine uniform Shade shade;\nout vec4 c;\n"
                     "layout(index = 1) subroutine(Shade) vec4 red(float x) { return vec4(x, 0, 0, 1); }\n"
                     "subroutine (Shade)\nvec4 blue(float x) { return vec4(0, 0, x, 1); }\n") +
             GetParam().fragment}});
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("[features.shade]\nvalues = [\"red\", \"blue\"]\ndefine = \"shade\"\n");
    const Composition composition = compose(family, {{0}, {1}}, search, Dialect::own).value();
    EXPECT_EQ(first_text(validate(family, composition, {}).diagnostics), "");
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << first_text(context.error());
    ASSERT_EQ(composition.permutations.size(), 2U);
    for (const Permutation& permutation : composition.permutations) {
        const Result<Program> program = link_program(*context, stages_of(composition, permutation));
        EXPECT_TRUE(program) << first_text(program.error());
        std::string text;
        for (const StageNames& names : kStages)
            if (const int stage = permutation.stages[names.kind]; stage >= 0)
                text += source_of(composition, composition.stage(stage));
        for (const std::string& kept : GetParam().kept) EXPECT_NE(text.find(kept), std::string::npos) << text;
    }
    EXPECT_NE(composition.permutations[0].stages, composition.permutations[1].stages);
}

const SubroutineRow with_subroutines[] = {
    {"called", plain, "void main() { c = shade(0.5); }\n", {}},
    {"attribute_of_the_name",
     "in vec4 shade;\nvoid main() { gl_Position = shade; }\n",
     "void main() { c = shade(0.5); }\n",
     {"in vec4 shade;"}},
    {"vertex_function_of_the_name",
     "vec4 shade(float x) { return vec4(x); }\nvoid main() { gl_Position = shade(1.0); }\n",
     "void main() { c = shade(0.5); }\n",
     {"vec4 shade(float x) {"}},
    {"member_of_the_name",
     plain,
     "struct Light { vec4 shade; vec4 red; };\nuniform Light light;\n"
     "void main() { c = shade(0.5) * light.shade * light.red; }\n",
     {"vec4 shade; vec4 red;", "light.shade * light.red"}},
    {"locals_of_both_names",
     plain,
     "void main() { float red = 0.5; float blue = red; vec4 shade = shade(red); c = shade * blue; }\n",
     {"float red = 0.5; float blue = red; vec4 shade = shade(red);"}},
    {"parameters_of_both_names",
     plain,
     "float half_of(float shade, float red, float blue) { return 0.5 * shade * red * blue; }\n"
     "void main() { c = shade(half_of(1.0, 2.0, 3.0)); }\n",
     {"half_of(float shade, float red, float blue)"}},
};

const auto name_of_row = [](const auto& row) { return std::string(row.param.name); };
INSTANTIATE_TEST_SUITE_P(Geometry, Stages, testing::ValuesIn(with_geometry), name_of_row);
INSTANTIATE_TEST_SUITE_P(Tessellation, Stages, testing::ValuesIn(with_tessellation), name_of_row);
INSTANTIATE_TEST_SUITE_P(Compute, Stages, testing::ValuesIn(with_compute), name_of_row);
INSTANTIATE_TEST_SUITE_P(All, SubroutineUniforms, testing::ValuesIn(with_subroutines), name_of_row);

}  // namespace
}  // namespace gobo
