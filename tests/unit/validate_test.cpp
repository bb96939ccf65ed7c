// Validating in memory: places, grouping, limits, versions.
#include "validate/validate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "family/selection.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Files = std::map<std::string, std::string, std::less<>>;

const char* const features =
    "[features]\nfog = { values = [\"none\", \"linear\"] }\npoint = { count = [0, 3], constant = \"POINTS\" "
    "}\n";
const char* const plain_vertex = "void main() { gl_Position = vec4(0.0); }\n";

class Validate : public testing::Test {
  protected:
    Validated all(Dialect dialect = Dialect::own, int jobs = 1, bool with_spirv_val = true,
                  bool in_children = false) {
        const MemoryFileSystem disk(files);
        SearchPath search;
        search.add(disk, "", "", false);
        const Family family = family_of(body);
        Selection selection;
        selection.all = true;
        const Composition composition =
            compose(family, select(family, selection, "450").value(), search, dialect).value();
        ValidateOptions options;
        options.jobs = jobs;
        options.spirv_val = with_spirv_val;
        options.child_processes = in_children;
        options.keep_spirv = true;
        return validate(family, composition, options);
    }

    std::vector<std::string> messages(Dialect dialect = Dialect::own) {
        std::vector<std::string> texts;
        for (const Diagnostic& diagnostic : all(dialect).diagnostics) texts.push_back(to_text(diagnostic));
        return texts;
    }

    std::string body;
    Files files = {{"tiny.vert", plain_vertex}, {"tiny.frag", "void main() {}\n"}};
};

TEST_F(Validate, MapsMessagesToThePieceAndItsLine) {
    body = features;
    files["tiny.frag"] =
        "#include <fog>\nlayout(location = 0) out vec4 color;\nvoid main() { color = seen(); }\n";
    files["fog/none.glsl"] = "// clear\n\nvec4 seen() { return vec4(1.0); }\n";
    files["fog/linear.glsl"] = "// thick\n\n\nvec4 seen() { return density; }\n";
    EXPECT_THAT(messages(),
                ElementsAre("fog/linear.glsl:4: error: 'density' : undeclared identifier "
                            "[fog=linear, and 3 more keys]\n    vec4 seen() { return density; }\n"))
        << "once, for the four keys with linear fog";
}

TEST_F(Validate, GroupsOverTheKeysThatShareAReason) {
    body = features;
    files["tiny.frag"] = "#if POINTS == 2\nvoid two() { missing; }\n#endif\nvoid main() {}\n";
    EXPECT_THAT(messages(), ElementsAre(HasSubstr("tiny.frag:2: error: 'missing' : undeclared identifier "
                                                  "[point=2, and 1 more key]\n")));
}

TEST_F(Validate, SaysTheSameWhateverTheNumberOfThreads) {
    body = features;
    files["tiny.frag"] =
        "#include <fog>\nlayout(location = 0) in vec3 normal;\n"
        "#if POINTS == 1\nvec2 wrong() { return normal; }\n#endif\nvoid main() { seen(normal); }\n";
    files["fog/none.glsl"] = "void seen(vec3 v) {}\n";
    files["fog/linear.glsl"] = "void seen(vec2 v) {}\n";
    const auto texts = [&](int jobs) { return to_text(all(Dialect::own, jobs).diagnostics); };
    const std::string alone = texts(1);
    EXPECT_THAT(alone, HasSubstr("error"));
    for (int i = 0; i < 10; ++i) ASSERT_EQ(texts(4), alone);
}

TEST_F(Validate, SaysTheSameInChildProcesses) {
    body = features;
    files["tiny.vert"] =
        "layout(location = 0) in vec4 position;\nlayout(location = 0) out vec3 normal;\n"
        "void main() { normal = position.xyz; gl_Position = position; }\n";
    files["tiny.frag"] =
        "#include <fog>\nstruct Lamp { vec3 color; bool on; };\nuniform Lamp lamps[2];\n"
        "layout(std140, binding = 1) uniform B { Lamp lamp; mat3 turn; float x[3]; } b;\n"
        "layout(binding = 2) uniform sampler2D map;\nlayout(location = 0) in vec3 normal;\n"
        "layout(location = 0) out vec4 color;\n"
        "#if POINTS == 1\nvec2 wrong() { return normal; }\n#endif\n"
        "void main() { color = vec4(lamps[1].color + b.lamp.color + b.turn * normal + b.x[POINTS - 1], "
        "1.0);\n"
        "color += texture(map, normal.xy) * seen(); }\n";
    files["fog/none.glsl"] = "float seen() { return 1.0; }\n";
    files["fog/linear.glsl"] = "float seen() { if (normal.x > 0.0) discard; return 0.5; }\n";
    const Validated threads = all(Dialect::own, 3);
    const Validated children = all(Dialect::own, 3, true, true);
    EXPECT_EQ(children.diagnostics, threads.diagnostics);
    EXPECT_THAT(threads.diagnostics, testing::Not(IsEmpty()));
    ASSERT_EQ(children.stages.size(), threads.stages.size());
    for (std::size_t i = 0; i < threads.stages.size(); ++i) {
        EXPECT_EQ(children.stages[i].spirv, threads.stages[i].spirv);
        EXPECT_EQ(children.stages[i].hash, threads.stages[i].hash);
        EXPECT_EQ(children.stages[i].interface, threads.stages[i].interface);
        EXPECT_EQ(children.stages[i].diagnostics, threads.stages[i].diagnostics);
    }
}

TEST_F(Validate, RefusesToReadWhatIsNotWritten) {
    files["tiny.frag"] =
        "layout(location = 0) in vec3 normal;\nlayout(location = 0) out vec4 color;\n"
        "void main() { color = vec4(normal, 1.0); }\n";
    EXPECT_THAT(messages(),
                ElementsAre("tiny.frag:1: error: the fragment stage reads 'vec3 normal', which the vertex "
                            "stage does not write [default]\n    layout(location = 0) in vec3 normal;\n"
                            "  help: declare and write it as an output of the vertex stage\n"));
}

TEST_F(Validate, AFailedLinkLeavesOtherPairsAlone) {
    body = "[features.fog]\nvalues = [\"none\", \"linear\"]\n";
    files["tiny.vert"] =
        "layout(location = 0) out vec2 normal;\nvoid main() { normal = vec2(0.0); gl_Position = vec4(0.0); "
        "}\n";
    files["tiny.frag"] =
        "#include <fog>\nlayout(location = 0) out vec4 color;\nvoid main() { color = seen(); }\n";
    files["fog/none.glsl"] =
        "layout(location = 0) in vec3 normal;\nvec4 seen() { return vec4(normal, 1.0); }\n";
    files["fog/linear.glsl"] = "layout(location = 0) in vec2 normal;\nvec4 seen() { return normal.xxyy; }\n";
    EXPECT_THAT(
        messages(),
        ElementsAre("fog/none.glsl:1: error: 'normal' is vec3 here, but vec2 in tiny.vert:1 [default]\n"
                    "    layout(location = 0) in vec3 normal;\n"
                    "  help: declare it alike in both stages\n"));
}

struct LimitRow {
    const char* name;
    Dialect dialect;
    const char* vertex;
    const char* fragment;
    const char* message;  ///< empty: just within the limit
};

void PrintTo(const LimitRow& row, std::ostream* stream) {
    *stream << row.name;
}

class Limit : public Validate, public testing::WithParamInterface<LimitRow> {};

TEST_P(Limit, IsKept) {
    files = {{"tiny.vert", GetParam().vertex}, {"tiny.frag", GetParam().fragment}};
    const std::vector<std::string> found = messages(GetParam().dialect);
    if (*GetParam().message == '\0') {
        EXPECT_THAT(found, IsEmpty());
    } else {
        EXPECT_THAT(found, ElementsAre(HasSubstr(GetParam().message)));
    }
}

constexpr const char* reads_block_1024 =
    "layout(std140, binding = 0) uniform B { vec4 v[1024]; } b;\nlayout(location = 0) out vec4 c;\n"
    "void main() { c = b.v[3]; }\n";
constexpr const char* reads_block_1025 =
    "layout(std140, binding = 0) uniform B { vec4 v[1025]; } b;\nlayout(location = 0) out vec4 c;\n"
    "void main() { c = b.v[3]; }\n";
constexpr const char* binds_36 =
    "BLOCK(36, B) { vec4 v; } b;\n"
    "layout(location = 0) out vec4 c;\nvoid main() { c = b.v; }\n";

INSTANTIATE_TEST_SUITE_P(
    Rows, Limit,
    testing::Values(
        LimitRow{"block_of_16_kib", Dialect::own, plain_vertex, reads_block_1024, ""},
        LimitRow{
            "block_beyond_16_kib", Dialect::own, plain_vertex, reads_block_1025,
            "bytes of the uniform block 'B': 16400, OpenGL guarantees only 16384 (MAX_UNIFORM_BLOCK_SIZE)"},
        LimitRow{
            "varyings_of_60", Dialect::own,
            "layout(location = 0) out vec4 v[15];\nvoid main() { v[0] = vec4(0.0); gl_Position = v[0]; }\n",
            "layout(location = 0) in vec4 v[15];\nlayout(location = 0) out vec4 c;\nvoid main() { c = v[14]; "
            "}\n",
            ""},
        LimitRow{
            "varyings_beyond_60", Dialect::own,
            "layout(location = 0) out vec4 v[16];\nvoid main() { v[0] = vec4(0.0); gl_Position = v[0]; }\n",
            "layout(location = 0) in vec4 v[16];\nlayout(location = 0) out vec4 c;\nvoid main() { c = v[14]; "
            "}\n",
            "varying components: 64, OpenGL guarantees only 60 (MAX_VARYING_COMPONENTS)"},
        LimitRow{"samplers_beyond_16", Dialect::own, plain_vertex,
                 "layout(binding = 0) uniform sampler2D t[17];\nlayout(location = 0) out vec4 c;\n"
                 "void main() { c = texture(t[3], vec2(0.0)); }\n",
                 "samplers in the fragment stage: 17, OpenGL guarantees only 16 (MAX_TEXTURE_IMAGE_UNITS)"},
        LimitRow{"binding_36_in_450", Dialect::glsl450, plain_vertex,
                 "layout(std140, binding = 36) uniform B { vec4 v; } b;\nlayout(location = 0) out vec4 c;\n"
                 "void main() { c = b.v; }\n",
                 ""},
        LimitRow{"binding_36_in_330", Dialect::glsl330, plain_vertex, binds_36,
                 "uniform buffer bindings up to that of 'B': 37, OpenGL guarantees only 36"}),
    [](const auto& row) { return row.param.name; });

/// What a template makes of a piece that lacks an end.
struct EndRow {
    const char* name;
    const char* piece;
    const char* message;  ///< with its place
};

class MissingEnd : public testing::TestWithParam<EndRow> {};

TEST_P(MissingEnd, IsToldWhereItIsMissing) {
    for (const char* template_text : {"#include \"a.glsl\"\n#include \"b.glsl\"\nlayout(location = 0) out "
                                      "vec4 c;\nvoid main() { c = vec4(b()); }\n",
                                      "layout(location = 0) out vec4 c;\n#include \"a.glsl\"\n#include "
                                      "\"b.glsl\"\nvoid main() { c = vec4(b()); }\n"}) {
        const MemoryFileSystem disk(Files{{"tiny.vert", plain_vertex},
                                          {"tiny.frag", template_text},
                                          {"a.glsl", GetParam().piece},
                                          {"b.glsl", "uniform float u;\nfloat b() { return u; }\n"}});
        SearchPath search;
        search.add(disk, "", "", false);
        const Family family = family_of("");
        const Composition composition = compose(family, {{}}, search, Dialect::own).value();
        const Diagnostics found = validate(family, composition, {}).diagnostics;
        EXPECT_THAT(first_text(found), testing::StartsWith(GetParam().message));
        if (std::string_view(GetParam().message).find("is missing") != std::string_view::npos) {
            EXPECT_EQ(found.size(), 1u) << "one cause is one message";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Rows, MissingEnd,
    testing::Values(
        EndRow{"semicolon", "const float a = 1.0 // one\n\n",
               "a.glsl:1: error: a ';' is missing behind the last declaration"},
        EndRow{"semicolon_of_a_prototype", "float a();\nfloat d()\n",
               "a.glsl:2: error: a ';' is missing behind"},
        EndRow{"semicolon_of_a_struct", "struct A {\n  float a;\n}\n",
               "a.glsl:3: error: a ';' is missing behind"},
        EndRow{"semicolon_of_a_block", "layout(std140, binding = 1) uniform A {\n  float a;\n}",
               "a.glsl:3: error: a ';' is missing behind"},
        EndRow{"semicolon_of_a_block_with_a_name", "layout(std140, binding = 1) uniform A {\n  float a;\n} a",
               "a.glsl:3: error: a ';' is missing behind"},
        EndRow{"semicolon_of_an_array", "const float a[2] = float[](1.0, 2.0)\n",
               "a.glsl:1: error: a ';' is missing behind"},
        EndRow{"brace", "float a() {\n  if (true) {\n    return 1.0;\n  }\n  return 0.0;\n// end\n",
               "a.glsl:5: error: a '}' is missing: nothing closes the '{' of line 1 [default]\n      return "
               "0.0;\n"},
        EndRow{"brace_within", "float a() {\n  if (true) {\n    return 1.0;\n  return 0.0;\n}\n",
               "a.glsl:5: error: a '}' is missing: nothing closes the '{' of line 1 [default]\n    }\n"},
        EndRow{"parenthesis", "const float a = max(1.0, 2.0\n",
               "a.glsl:1: error: a ')' is missing: nothing closes the '(' of line 1"},
        EndRow{"bracket", "uniform float a[3\n",
               "a.glsl:1: error: a ']' is missing: nothing closes the '[' of line 1"},
        EndRow{"semicolon_within_a_line", "float a() { return 1.0 }\n",
               "a.glsl:1: error: '' :  syntax error"},
        EndRow{
            "semicolon_of_a_statement", "float a() {\n  float x = 2.0\n\n  // x\n  return x;\n}\n",
            "a.glsl:2: error: a ';' is missing behind '2.0' [default]\n      float x = 2.0\n  help: end it "
            "before the 'return' of line 5\n"},
        EndRow{"semicolon_of_a_call",
               "float a() {\n  float x;\n  x = max(1.0,\n    2.0)\n  x = 1.0;\n"
               "  return x;\n}\n",
               "a.glsl:4: error: a ';' is missing behind ')' [default]\n        2.0)\n"},
        EndRow{"semicolon_before_a_brace", "float a() {\n  return 1.0\n}\n",
               "a.glsl:2: error: a ';' is missing behind '1.0'"},
        EndRow{"semicolon_between_declarations", "uniform float k\nuniform float l;\n",
               "a.glsl:1: error: a ';' is missing behind 'k'"},
        EndRow{"semicolon_of_a_struct_within", "struct A { float a; }\nfloat b2() { return 1.0; }\n",
               "a.glsl:1: error: a ';' is missing behind '}'"},
        EndRow{"no_semicolon_behind_a_condition",
               "void a(float x) {\n  if (x > 0.0)\n  float y = x float z;\n}\n",
               "a.glsl:3: error: '' :  syntax error, unexpected FLOAT"},
        EndRow{"no_semicolon_behind_else",
               "void a(float x) {\n  if (x > 0.0) x = 1.0; else\n  float y = x float z;\n}\n",
               "a.glsl:3: error: '' :  syntax error, unexpected FLOAT"},
        EndRow{"no_semicolon_behind_a_block",
               "void a(float x) {\n  { x = 1.0; }\n  float y = x float z;\n}\n",
               "a.glsl:3: error: '' :  syntax error, unexpected FLOAT"},
        EndRow{"no_semicolon_behind_an_operator", "float a(float x) {\n  return x *\n  / 2.0;\n}\n",
               "a.glsl:3: error: '' :  syntax error"},
        EndRow{"brace_too_many", "float a() { return 1.0; }\n}\n", "a.glsl:2: error: '' :  syntax error"},
        EndRow{"brace_under_a_condition",
               "#ifdef A\nfloat a() {\n#else\nfloat b2() {\n#endif\n return 1.0;\n", ""},
        EndRow{"nothing", "float a() { return 1.0; }\n", ""},
        EndRow{"nothing_but_another_mistake", "float a() { return oops; }\n", "a.glsl:1: error: 'oops'"},
        EndRow{"nothing_in_a_macro", "#define BEGIN {\n#define END }\nfloat a() BEGIN return 1.0; END\n",
               ""}),
    [](const auto& row) { return row.param.name; });

TEST_F(Validate, LetsNoPieceCloseAnothersBracket) {
    files["tiny.frag"] =
        "#include \"a.glsl\"\n#include \"b.glsl\"\nlayout(location = 0) out vec4 c;\nvoid main() { c = oops; "
        "}\n";
    files["a.glsl"] = "float a() {\n";
    files["b.glsl"] = "return 1.0; }\n";
    EXPECT_THAT(messages(), ElementsAre(HasSubstr("tiny.frag:4: error: 'oops'"))) << "which GLSL allows";
}

TEST_F(Validate, PutsDepthLayoutsOfAnExtensionIntoSpirv) {
    files["tiny.vert"] = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    files["tiny.frag"] =
        "#version 330 core\n#extension GL_ARB_conservative_depth : require\n"
        "layout(depth_less) out float gl_FragDepth;\nvoid main() { gl_FragDepth = 0.0; }\n";
    const Validated validated = all();
    EXPECT_THAT(validated.diagnostics, IsEmpty());
    const SpirvModule& module = validated.stages.back().spirv;
    const std::uint32_t head = 3U << spv::WordCountShift | spv::OpExecutionMode;
    bool is_stated = false;
    for (std::size_t i = 0; i + 2 < module.size(); ++i)
        is_stated = is_stated || (module[i] == head && module[i + 2] == spv::ExecutionModeDepthLess);
    EXPECT_TRUE(is_stated);
}

TEST_F(Validate, WantsAMain) {
    for (const char* text : {"", "\n", "float f() { return 1.0; }\n", "void Main() {}\n", "void main();\n",
                             "#if 0\nvoid main() {}\n#endif\n"}) {
        files["tiny.frag"] = text;
        EXPECT_THAT(messages(), ElementsAre("tiny.frag: error: the fragment stage has no main() [default]\n"
                                            "  help: write void main() in the template\n"))
            << text;
    }
}

/// Comments where they could mean something. Both shaders compile to the same module or to none.
struct HostileRow {
    const char* name;
    const char* text;  ///< before main(), which reads A
    bool compiles = true;
};

void PrintTo(const HostileRow& row, std::ostream* stream) {
    *stream << row.name;
}

class HostileComment : public testing::TestWithParam<std::tuple<Dialect, HostileRow>> {};

TEST_P(HostileComment, MeansTheSameWhenItIsGone) {
    const auto& [dialect, row] = GetParam();
    const Files files = {
        {"tiny.vert", plain_vertex},
        {"tiny.frag",
         std::string(row.text) + "\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(A); }\n"}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("");
    ValidateOptions options;
    options.keep_spirv = options.debug_information = true;
    std::vector<SpirvModule> modules;
    std::vector<std::string> sources;
    for (const Comments comments : {Comments::keep, Comments::remove}) {
        const Composition composition = compose(family, {{}}, search, dialect, comments).value();
        const Validated validated = validate(family, composition, options);
        const auto fragment =
            static_cast<std::size_t>(composition.permutations.front().stages[StageKind::fragment]);
        modules.push_back(validated.stages[fragment].spirv);
        sources.push_back(source_of(composition, composition.stages[fragment]));
        EXPECT_EQ(exit_status(validated.diagnostics) == 0, row.compiles)
            << first_text(validated.diagnostics) << sources.back();
    }
    EXPECT_EQ(modules[0], modules[1]) << "lines included: " << sources[1];
}

INSTANTIATE_TEST_SUITE_P(
    Rows, HostileComment,
    testing::Combine(
        testing::Values(Dialect::glsl330, Dialect::glsl450),
        testing::Values(
            HostileRow{"between_tokens", "const/**/float A/* b */=/* c */1.0;// d"},
            HostileRow{"within_a_number", "const float A = 1/**/.0;", false},
            HostileRow{"within_an_operator", "const float A = 1.0 +/**/+ 2.0;"},
            HostileRow{"before_a_parameter_list", "#define F/* a */(x) x\nconst float x = 1.0, A = F(x);",
                       false},
            HostileRow{"before_an_object_like_body", "#define F/* a */(2.0)\nconst float A = F;"},
            HostileRow{"before_a_directive", "/* a\n */ #define A 1.0"},
            HostileRow{"within_a_directive", "# /* a */ define /* b */ A 1.0 // c"},
            HostileRow{"over_lines_within_a_directive", "#define A 1.0 /* a\n b */ + 2.0"},
            HostileRow{"over_lines_behind_a_directive", "#define A 1.0 /* a\n b */\nconst int b = 1;"},
            HostileRow{"over_lines_before_a_number_sign", "const int b = 1; /* a\n */ #define A 1.0", false},
            HostileRow{"in_a_joined_directive", "#define A 1.0 /* a */ \\\n + 2.0"},
            HostileRow{"over_lines_in_a_joined_directive", "#define A \\\n/* a\n */ 1.0"},
            HostileRow{"behind_a_backslash", "#define A 1.0\n#if 0\n\\ // a\n#endif\nconst int b = 1;"},
            HostileRow{"that_ends_in_a_backslash", "const int b = 1; // a \\\nconst float A = 1.0;", false},
            HostileRow{"that_hides_a_line", "#define A 1.0\n// a \\\nconst float A = 2.0;\n"},
            HostileRow{"begun_on_two_lines", "#define A 1.0\n/\\\n/ a\n"},
            HostileRow{"in_a_skipped_group",
                       "#if 0\n/* don't\n#endif\n// \" */\n#endif\nconst float A = 1.0;"},
            HostileRow{"in_a_skipped_message", "#if 0\n#error \"http://a\"\n#endif\nconst float A = 1.0;"},
            HostileRow{"in_a_condition", "#if 1 /* a */ && /* b\n */ 0\n#else\nconst float A = 1.0;\n#endif"},
            HostileRow{"behind_an_else", "#if 0\n#else // a\nconst float A = 1.0;\n#endif /* b */"},
            HostileRow{"of_comments", "/*/ /* // */const float A = 1.0; //* a\n/**//**/"},
            HostileRow{"with_windows_line_ends", "const float\r\n// a\r\nA /* b\r\n */ = 1.0;\r\n"},
            HostileRow{"with_old_line_ends", "// a\rconst float A = 1.0;"})),
    [](const auto& row) {
        return std::string(std::get<1>(row.param).name) + "_" + std::string(name_of(std::get<0>(row.param)));
    });

/// Loose shaders of every version that glslang knows, whether or not SPIR-V does.
struct VersionRow {
    const char* name;
    const char* vertex;
    const char* fragment;
};

void PrintTo(const VersionRow& row, std::ostream* stream) {
    *stream << row.name;
}

class Version : public Validate, public testing::WithParamInterface<VersionRow> {};

TEST_P(Version, IsTakenAndReflected) {
    files = {{"tiny.vert", GetParam().vertex}, {"tiny.frag", GetParam().fragment}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("");
    const Composition composition = compose(family, {{}}, search, Dialect::own).value();
    const Validated validated = validate(family, composition, {});
    EXPECT_EQ(exit_status(validated.diagnostics), 0) << first_text(validated.diagnostics);
    const Interface interface = interface_of(validated, composition.permutations.front());
    ASSERT_EQ(interface.uniforms.size(), 1u);
    EXPECT_EQ(interface.uniforms[0].name, "tint");
    EXPECT_EQ(interface.uniforms[0].type, "vec4");
    ASSERT_EQ(interface.inputs.size(), 1u);
    EXPECT_EQ(interface.inputs[0].name, "place");
}

constexpr const char* new_vertex =
    "in vec4 place;\nout vec4 shade;\nvoid main() { shade = place; gl_Position = place; }\n";
constexpr const char* new_fragment =
    "precision highp float;\nuniform vec4 tint;\nin vec4 shade;\nout vec4 color;\nvoid main() { color = tint "
    "* shade; }\n";
constexpr const char* old_vertex =
    "attribute vec4 place;\nvarying vec4 shade;\nvoid main() { shade = place; gl_Position = place; }\n";
constexpr const char* old_fragment =
    "precision highp float;\nuniform vec4 tint;\nuniform sampler2D image;\nvarying vec4 shade;\n"
    "void main() { gl_FragColor = tint * texture2D(image, shade.xy); }\n";

const std::string version_texts[][2] = {
    {std::string("#version 120\n") + old_vertex, std::string("#version 120\n") + (old_fragment + 23)},
    {std::string("#version 100\n") + old_vertex, std::string("#version 100\n") + old_fragment},
    {std::string("#version 130\n") + new_vertex, std::string("#version 130\n") + new_fragment},
    {std::string("#version 150\n") + new_vertex, std::string("#version 150\n") + new_fragment},
    {std::string("#version 300 es\n") + new_vertex, std::string("#version 300 es\n") + new_fragment},
    {std::string("#version 310 es\n") + new_vertex, std::string("#version 310 es\n") + new_fragment},
    {std::string("#version 330 core\n") + new_vertex, std::string("#version 330 core\n") + new_fragment},
    {std::string("#version 330 compatibility\n") + new_vertex,
     std::string("#version 330 compatibility\n") + new_fragment},
    {std::string("#version 420\n") + new_vertex, std::string("#version 420\n") + new_fragment},
    {std::string("#version 450\n") + new_vertex, std::string("#version 450\n") + new_fragment},
    {std::string("#version 460\n") + new_vertex, std::string("#version 460\n") + new_fragment},
};

std::vector<VersionRow> version_rows() {
    const char* names[] = {"v120", "v100", "v130", "v150", "v300es", "v310es", "v330", "v330compatibility",
                           "v420", "v450", "v460"};
    std::vector<VersionRow> rows;
    for (std::size_t i = 0; i < std::size(names); ++i)
        rows.push_back({names[i], version_texts[i][0].c_str(), version_texts[i][1].c_str()});
    return rows;
}

INSTANTIATE_TEST_SUITE_P(Rows, Version, testing::ValuesIn(version_rows()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
