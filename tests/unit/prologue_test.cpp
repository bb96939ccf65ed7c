// What a family puts in front of its stages and into their text: version, prologue, macros, substituted text.
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/key.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

using Files = std::map<std::string, std::string, std::less<>>;

/// A stage without empty lines, or the first error.
std::string composed(const std::string& body, const std::string& fragment, const std::string& key,
                     StageKind kind = StageKind::fragment, Dialect dialect = Dialect::own, Files files = {}) {
    files.try_emplace("tiny.vert", "void main() { EDGE STEPS }\n");
    files.try_emplace("tiny.frag", fragment);
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of(body);
    const Result<Composition> composition =
        compose(family, {parse_key(family, key).value()}, search, dialect);
    if (!composition) return first_text(composition.error());
    const StageNumbers& stages = composition->permutations.front().stages;
    const std::string text = source_of(*composition, composition->stage(stages[kind]));
    std::string dense;
    for (const char character : text)
        if (character != '\n' || (!dense.empty() && dense.back() != '\n')) dense += character;
    return dense;
}

struct Row {
    const char* name;
    const char* body;      ///< of tiny.toml, behind its first three lines
    const char* fragment;  ///< tiny.frag
    const char* key;
    const char* expected;  ///< the stage without empty lines, or the first error
    StageKind kind = StageKind::fragment;
    Dialect dialect = Dialect::own;
};

class InFront : public testing::TestWithParam<Row> {};

TEST_P(InFront, IsExactly) {
    const Row& row = GetParam();
    EXPECT_EQ(composed(row.body, row.fragment, row.key, row.kind, row.dialect), row.expected);
}

constexpr const char* soft =
    "[features.edge]\ndefine = \"EDGE\"\nvalues = [\"off\", \"hard\", \"soft\", \"4\"]\n"
    "text = { off = false, hard = \"\", soft = \"vec2(0.5, 1)\" }\n";
constexpr const char* lamps = "unroll_loops = true\n[features.lamps]\ncount = [0, 2]\nconstant = \"LAMPS\"\n";
constexpr const char* loop =
    "#if LAMPS > 0\n#pragma unroll_loop_start\nfor ( int k = 0; k < LAMPS; k ++ ) {\n"
    "#if UNROLLED_LOOP_INDEX < 1\nfirst\n#endif\nlamp[k]; { UNROLLED_LOOP_INDEX }\n}\n#pragma "
    "unroll_loop_end\n#endif\n";
constexpr const char* half = "[features.half]\ndefine = \"HALF\"\ntext = \"0.4\"\n";

INSTANTIATE_TEST_SUITE_P(
    Rows, InFront,
    testing::Values(
        Row{"version_of_the_family", "version = \"330 core\"\n", "main", "default",
            "#version 330 core\nmain\n"},
        Row{"version_of_both", "version = \"330 core\"\n", "#version 330\nmain", "default",
            "#version 330 core\nmain\n"},
        Row{"version_by_dialect", "version = \"330 core\"\n", "#version 410\nmain", "default",
            "#version 450 core\nmain\n", StageKind::fragment, Dialect::glsl450},
        Row{"version_of_another", "version = \"330 core\"\n", "\n#version 410\nmain", "default",
            "tiny.frag:2:1: error: #version 410 where the family states 330 core [default]\n"
            "    #version 410\n"
            "    ^\n"
            "  help: leave one of them out: the family's is at tiny.toml:4\n"},
        Row{"prologue",
            "version = \"300 es\"\n[prologue]\ntext = '''\n#define A 1\n'''\nfragment = \"precision highp "
            "float;\"\n"
            "vertex = \"int v;\"\n",
            "main", "default", "#version 300 es\n#define A 1\nprecision highp float;\nmain\n"},
        Row{"prologue_before_varyings",
            "version = \"300 es\"\n[prologue]\nfragment = \"precision highp float;\"\n"
            "[varyings.uv]\nlocation = 0\ntype = \"vec2\"\nvalue = \"vec2(0)\"\n",
            "uv", "default",
            "#version 300 es\n#define VARYING(location_) in\nprecision highp float;\nVARYING(0) vec2 "
            "uv;\nuv\n"},
        Row{"prologue_of_the_other_stage", "[prologue]\nvertex = \"int v;\"\n", "main", "default",
            "#version 450 core\nmain\n"},
        Row{"prologue_with_extension", "[prologue]\ntext = \"#extension GL_A : enable\"\n", "main", "default",
            "#version 450 core\n#extension GL_A : enable\nmain\n"},
        Row{"prologue_with_version", "[prologue]\ntext = '''\n#version 330\n'''\n", "main", "default",
            "tiny.toml:6:1: error: a #version in the family's prologue [default]\n"
            "    #version 330\n"
            "    ^\n"
            "  help: write version = \"330\" at the top of the family file\n"},
        Row{"prologue_that_mentions_a_feature",
            "[prologue]\ntext = '''\n#ifdef HALF\nhalf\n#endif\n'''\n[features.half]\ndefine = \"HALF\"\n",
            "main", "half=on", "#version 450 core\n#define HALF 1\n#ifdef HALF\nhalf\n#endif\nmain\n"},
        Row{"value_undefined", soft, "EDGE", "default", "#version 450 core\nEDGE\n"},
        Row{"value_empty", soft, "EDGE", "edge=hard", "#version 450 core\n#define EDGE\nEDGE\n"},
        Row{"value_with_text", soft, "EDGE", "edge=soft",
            "#version 450 core\n#define EDGE vec2(0.5, 1)\nEDGE\n"},
        Row{"value_is_its_text", soft, "EDGE", "edge=4", "#version 450 core\n#define EDGE 4\nEDGE\n"},
        Row{"value_not_mentioned", soft, "main", "edge=4", "#version 450 core\nmain\n"},
        Row{"define_with_text", half, "HALF", "half=on", "#version 450 core\n#define HALF 0.4\nHALF\n"},
        Row{"define_with_both_texts", "[features.half]\ndefine = \"HALF\"\ntext = { off = \"0\" }\n", "HALF",
            "default", "#version 450 core\n#define HALF 0\nHALF\n"},
        Row{"text_that_mentions_another",
            "[features]\na = { define = \"A\", text = \"(B + 1)\" }\nb = { define = \"B\", text = \"C\" }\n"
            "c = { count = [2, 3], constant = \"C\" }\n",
            "A", "a=on b=on", "#version 450 core\n#define A (B + 1)\n#define B C\n#define C 2\nA\n"},
        Row{"of_this_stage", "[features.edge]\ndefine = \"EDGE\"\nstages = [\"vertex\"]\n", "EDGE", "edge=on",
            "#version 450 core\n#define EDGE 1\nvoid main() { EDGE STEPS }\n", StageKind::vertex},
        Row{"of_another_stage", "[features.edge]\ndefine = \"EDGE\"\nstages = [\"vertex\"]\n", "EDGE",
            "edge=on", "#version 450 core\nEDGE\n"},
        Row{"count_from_two", "[features.steps]\ncount = [2, 4]\nconstant = \"STEPS\"\n", "STEPS", "default",
            "#version 450 core\n#define STEPS 2\nSTEPS\n"},
        Row{"count_above_its_least", "[features.steps]\ncount = [2, 4]\nconstant = \"STEPS\"\n", "STEPS",
            "steps=4", "#version 450 core\n#define STEPS 4\nSTEPS\n"},
        Row{"clash", half, "\n#define HALF 0.5\nHALF", "half=on",
            "tiny.frag:2:1: error: this gives 'HALF' another text than feature 'half' does [half=on]\n"
            "    #define HALF 0.5\n"
            "    ^\n"
            "  help: put it between #ifndef HALF and #endif, as what holds where the key leaves it "
            "undefined; "
            "the feature is at tiny.toml:4\n"},
        Row{"clash_where_it_is_off", half, "#define HALF 0.5\nHALF", "default",
            "#version 450 core\n#define HALF 0.5\nHALF\n"},
        Row{"same_text", half, "#define HALF  0.4\nHALF", "half=on",
            "#version 450 core\n#define HALF 0.4\n#define HALF  0.4\nHALF\n"},
        Row{"guarded", half, "#ifndef HALF\n#define HALF 0.5\n#endif\nHALF", "half=on",
            "#version 450 core\n#define HALF 0.4\n#ifndef HALF\n#define HALF 0.5\n#endif\nHALF\n"},
        Row{"undefined_first", half, "#undef HALF\n#define HALF 0.5\nHALF", "half=on",
            "#version 450 core\n#define HALF 0.4\n#undef HALF\n#define HALF 0.5\nHALF\n"},
        Row{"clash_in_the_prologue",
            "[prologue]\ntext = \"#define HALF 0.5\"\n[features.half]\ndefine = \"HALF\"\n", "HALF",
            "half=on",
            "tiny.toml:5:1: error: this gives 'HALF' another text than feature 'half' does [half=on]\n"
            "    #define HALF 0.5\n"
            "    ^\n"
            "  help: put it between #ifndef HALF and #endif, as what holds where the key leaves it "
            "undefined; "
            "the feature is at tiny.toml:6\n"},
        Row{"substituted",
            "[features]\nedge = { values = [\"hard\", \"soft\"], text = { soft = \"0.5\" }, substitute = "
            "\"@edge@\" }\n"
            "lit = { substitute = \"$lit\" }\nlamps = { count = [1, 3], substitute = \"@lamps@\" }\n",
            "#if $lit\n@edge@ @lamps@ $lit $lits a@b\n#endif", "edge=soft lit=on lamps=2",
            "#version 450 core\n#if 1\n0.5 2 1 $lits a@b\n#endif\n"},
        Row{"substituted_by_the_family", "[substitute]\ngl_FragColor = \"color\"\n'%x%' = '1'\n",
            "gl_FragColor %x% gl_FragColors", "default", "#version 450 core\ncolor 1 gl_FragColors\n"},
        Row{"loop_of_two_rounds", lamps, loop, "lamps=2",
            "#version 450 core\n#define LAMPS 2\n#if LAMPS > 0\n#pragma unroll_loop_start\n"
            "{ const int k = 0;\n#if 0 < 1\nfirst\n#endif\nlamp[k]; { 0 }\n}\n"
            "{ const int k = 1;\n#if 1 < 1\nfirst\n#endif\nlamp[k]; { 1 }\n}\n#endif\n"},
        Row{"loop_left_out", lamps,
            "#define LIT 1\n#ifdef LAMP\n#pragma unroll_loop_start\nfor(;;){}\n#pragma "
            "unroll_loop_end\n#endif",
            "default",
            "#version 450 core\n#define LIT 1\n#ifdef LAMP\n#pragma unroll_loop_start\nfor(;;){}\n#pragma "
            "unroll_loop_end\n#endif\n"},
        Row{"loop_of_another_form", lamps,
            "\n#pragma unroll_loop_start\nwhile (true) {}\n#pragma unroll_loop_end\n", "default",
            "tiny.frag:2:1: error: the loop behind this has another form than can be unrolled [default]\n"
            "    #pragma unroll_loop_start\n"
            "    ^\n"
            "  help: write for (int i = 0; i < COUNT; i++) { ... }, with < and not <=, without an #include, "
            "between the two pragmas\n"},
        Row{"loop_left_by_a_jump", lamps,
            "for (;;) {\n#pragma unroll_loop_start\nfor (int i = 0; i < LAMPS; i++) {\n"
            "for (;;) break;\nif (i > 0) continue;\n}\n#pragma unroll_loop_end\n}\n",
            "default",
            "tiny.frag:5: error: 'continue' of a loop that is unrolled, which leaves no loop behind "
            "[default]\n"
            "    if (i > 0) continue;\n"
            "  help: write the loop without it, or take the pragmas away\n"},
        Row{"loop_left_by_a_jump_within_a_switch", lamps,
            "#pragma unroll_loop_start\nfor (int i = 0; i < LAMPS; i++) {\n"
            "switch (i) { case 0: break; default: continue; }\n}\n#pragma unroll_loop_end\n",
            "default",
            "tiny.frag:3: error: 'continue' of a loop that is unrolled, which leaves no loop behind "
            "[default]\n"
            "    switch (i) { case 0: break; default: continue; }\n"
            "  help: write the loop without it, or take the pragmas away\n"},
        Row{"jumps_of_loops_within", "unroll_loops = true\n",
            "#pragma unroll_loop_start\nfor (int i = 0; i < 1; i++) {\n"
            "for (;;) if (a) { b; } else break;\ndo { continue; } while (c);\n}\n"
            "#pragma unroll_loop_end\nbreak;\n",
            "default",
            "#version 450 core\n#pragma unroll_loop_start\n{ const int i = 0;\n"
            "for (;;) if (a) { b; } else break;\ndo { continue; } while (c);\n}\nbreak;\n"},
        Row{"loop_within_a_loop", lamps,
            "#pragma unroll_loop_start\nfor (int i = 0; i < LAMPS; i++) {\n#ifdef LIT\n"
            "#pragma unroll_loop_start\nfor (int k = 0; k < 2; k++) {}\n#pragma unroll_loop_end\n"
            "#endif\n}\n#pragma unroll_loop_end\n",
            "default",
            "tiny.frag:4:1: error: a loop to be unrolled within that behind line 1, which is to be unrolled, "
            "too [default]\n"
            "    #pragma unroll_loop_start\n"
            "    ^\n"
            "  help: take the two pragmas of one of them away\n"},
        Row{"loops_one_of_which_is_left_out", lamps,
            "#ifdef LIT\n#pragma unroll_loop_start\n#include \"none\"\n#pragma unroll_loop_end\n#else\n"
            "#pragma unroll_loop_start\nfor (int i = 0; i < 1; i++) { i; }\n#pragma unroll_loop_end\n"
            "#endif\n",
            "default",
            "#version 450 core\n#ifdef LIT\n#pragma unroll_loop_start\n#pragma unroll_loop_end\n#else\n"
            "#pragma unroll_loop_start\n{ const int i = 0; i; }\n#endif\n"},
        Row{"loop_without_a_known_end", lamps,
            "#pragma unroll_loop_start\nfor (int i = 0; i < GL_many; i++) {}\n#pragma unroll_loop_end\n",
            "default",
            "tiny.frag:1:1: error: the loop behind this ends at 'GL_many', which is no number below 4096 "
            "[default]\n"
            "    #pragma unroll_loop_start\n"
            "    ^\n"
            "  help: define it by a count of the family or a macro\n"},
        Row{"substituted_by_default",
            "[features]\nedge = { values = [\"hard\", \"soft\"], text = { soft = \"0.5\" }, substitute = "
            "\"@edge@\" }\n"
            "lit = { substitute = \"$lit\" }\n",
            "@edge@ $lit", "default", "#version 450 core\nhard 0\n"}),
    [](const auto& row) { return row.param.name; });

TEST(InFront, StandsOnTheLinesOfTheFamilyFile) {
    const MemoryFileSystem disk(Files{{"tiny.vert", "v"}, {"tiny.frag", "f"}});
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("[prologue]\ntext = '''\nint a;\nint b;'''\nfragment = 'int c;'\n");
    const Composition composition = compose(family, {Key()}, search, Dialect::own).value();
    const Stage& stage = composition.stage(composition.permutations.front().stages[StageKind::fragment]);
    const Piece& all = composition.piece(stage.pieces.at(1));
    const Piece& one = composition.piece(stage.pieces.at(2));
    EXPECT_EQ(all.name + "|" + all.path + "|" + all.text, "tiny[prologue]|tiny.toml|int a;\nint b;\n");
    EXPECT_EQ(all.first_line, 6);
    EXPECT_EQ(one.name + "|" + one.path + "|" + one.text, "tiny[prologue.fragment]|tiny.toml|int c;\n");
    EXPECT_EQ(one.first_line, 8);
    EXPECT_FALSE(all.on_disk) << "a depfile names the family file anyway";
}

TEST(InFront, SharesTheFilesInWhichNothingIsSubstituted) {
    const MemoryFileSystem disk(
        Files{{"tiny.vert", "v"}, {"tiny.frag", "#include \"a.glsl\"\n@lit@"}, {"a.glsl", "a"}});
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("[features.lit]\nsubstitute = \"@lit@\"\n");
    const Composition composition = compose(family, {Key{0}, Key{1}}, search, Dialect::own).value();
    EXPECT_EQ(composition.stages.size(), 3u) << "one vertex stage, two fragment stages";
    EXPECT_EQ(composition.pieces.size(), 5u) << "the prologue, v, a, and tiny.frag twice";
}

struct RuleRow {
    const char* name;
    const char* line;  ///< of tiny.frag
    const char* expected;
};

class IncludeRules : public testing::TestWithParam<RuleRow> {};

TEST_P(IncludeRules, FindWhatTheLineMeans) {
    constexpr const char* body =
        "[features]\nfog = { values = [\"none\"] }\nlit = { define = \"LIT\" }\n[includes]\n"
        "'#include <*>' = 'chunks/*.glsl'\n'#include <x_*>' = 'x/*.glsl'\n'#pragma import \"*\"' = '*'\n"
        "'//!include *' = '*.h'\n'@include(\"*\")' = '*'\n";
    const Files files = {{"fog/none.glsl", "feature"},
                         {"chunks/fog.glsl", "wrong"},
                         {"chunks/a.glsl", "chunk"},
                         {"chunks/lit.glsl", "lit"},
                         {"x/a.glsl", "x"},
                         {"h/b.h", "header"},
                         {"b.glsl", "imported"}};
    EXPECT_EQ(composed(body, std::string("int begin;\n") + GetParam().line + "\nend", "default",
                       StageKind::fragment, Dialect::own, files),
              GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, IncludeRules,
    testing::Values(
        RuleRow{"angles", "#include <a>", "#version 450 core\nint begin;\nchunk\nend\n"},
        RuleRow{"longest_rule", "#include <x_a>", "#version 450 core\nint begin;\nx\nend\n"},
        RuleRow{"feature", "#include <fog>", "#version 450 core\nint begin;\nfeature\nend\n"},
        RuleRow{"define", "#include <lit>", "#version 450 core\nint begin;\nlit\nend\n"},
        RuleRow{"blanks", "\t#  include   <a> // chunk", "#version 450 core\nint begin;\nchunk\nend\n"},
        RuleRow{"pragma", "#pragma import \"b.glsl\"", "#version 450 core\nint begin;\nimported\nend\n"},
        RuleRow{"comment", "//!include h/b", "#version 450 core\nint begin;\nheader\nend\n"},
        RuleRow{"call", "@include(\"b.glsl\");", "#version 450 core\nint begin;\nimported\nend\n"},
        RuleRow{"within_a_comment", "/*\n#include <nothing>\n*/", "#version 450 core\nint begin;\nend\n"},
        RuleRow{"missing", "#include <nothing>",
                "tiny.frag:2:1: error: no piece 'chunks/nothing.glsl' [default]\n"
                "    #include <nothing>\n"
                "    ^\n"
                "  help: searched .; nearest: 'chunks/fog.glsl'\n"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
