// What the composer reads of one file.
#include "compose/scan_piece.hpp"

#include <ctime>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_families.hpp"

namespace gobo {
namespace {

TEST(ScanPiece, BlanksDirectivesAndKeepsLines) {
    const ScannedPiece piece = scan_piece(
                                   "// head\n#version 330 core // as it was\n  # include  <fog>\n"
                                   "#include \"common/math.glsl\"\n\nfloat f() { return 1.0; }",
                                   "a.glsl")
                                   .value();
    EXPECT_EQ(piece.text, "// head\n                  // as it was\n\n\n\nfloat f() { return 1.0; }\n")
        << "with a newline at its end";
    EXPECT_EQ(piece.code, "\n\n\n\n\nfloat f() { return 1.0; }\n");
    EXPECT_EQ(piece.version, "330 core");
    ASSERT_EQ(piece.includes.size(), 2u);
    EXPECT_TRUE(piece.includes[0].in_angles);
    EXPECT_EQ(piece.includes[0].target, "fog");
    EXPECT_EQ(piece.includes[0].place, (Place{"a.glsl", 3, 3}));
    EXPECT_EQ(piece.includes[0].line, "  # include  <fog>");
    EXPECT_FALSE(piece.includes[1].in_angles);
    EXPECT_EQ(piece.includes[1].target, "common/math.glsl");
}

TEST(ScanPiece, SeesNothingInComments) {
    const ScannedPiece piece = scan_piece(
                                   "// #include <fog>\n/* #include <fog>\n#version 100\n hidden */\n"
                                   "int seen; // unseen\n",
                                   "a.glsl")
                                   .value();
    EXPECT_TRUE(piece.includes.empty());
    EXPECT_TRUE(piece.version.empty());
    EXPECT_THAT(identifiers_of(piece.code), testing::ElementsAre("int", "seen"));
}

struct OwnLineRow {
    const char* name;
    const char* text;
    const char* code;
};

class OwnLine : public testing::TestWithParam<OwnLineRow> {};

TEST_P(OwnLine, IsTheNumberInTheFile) {
    const ScannedPiece piece = scan_piece(GetParam().text, "a.glsl").value();
    EXPECT_EQ(piece.code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, OwnLine,
    testing::Values(
        OwnLineRow{"in_code", "\nint a = __LINE__;\n", "\nint a = 2       ;\n"},
        OwnLineRow{"twice", "int a = __LINE__+__LINE__;\n", "int a = 1       +1       ;\n"},
        OwnLineRow{"in_a_condition", "\n#if __LINE__ > 1\n#endif\n", "\n#if 2        > 1\n#endif\n"},
        OwnLineRow{"behind_a_comment", "/* __LINE__\n*/ int a = __LINE__;\n", "\n   int a = 2       ;\n"},
        OwnLineRow{"behind_a_joined_line", "int a = 1 \\\n+ 1;\nint b = __LINE__;\n",
                   "int a = 1 + 1;\n\nint b = 3       ;\n"},
        OwnLineRow{"of_a_longer_name", "int my__LINE__;\n", "int my__LINE__;\n"},
        OwnLineRow{"in_a_macro", "#define A __LINE__\nint a = A;\n", "#define A __LINE__\nint a = A;\n"},
        OwnLineRow{"counted_anew", "#line 100\nint a = __LINE__;\n", "\nint a = __LINE__;\n"}),
    [](const auto& row) { return row.param.name; });

struct CommentRow {
    const char* name;
    const char* text;
    const char* code;
};

class Comment : public testing::TestWithParam<CommentRow> {};

TEST_P(Comment, BecomesBlanks) {
    EXPECT_EQ(scan_piece(GetParam().text, "a.glsl").value().code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, Comment,
    testing::Values(
        CommentRow{"behind_code", "int a; // b\nint c; /* d */\n", "int a;\nint c;\n"},
        CommentRow{"between_tokens", "int/**/a = 1 /* b */ + 2;\n", "int    a = 1         + 2;\n"},
        CommentRow{"over_lines", "/* a\n * b\n */ int c;\n", "\n\n    int c;\n"},
        CommentRow{"behind_code_over_lines", "int a; /* b\n c */\n", "int a;\n\n"},
        CommentRow{"amid_a_directive_over_lines", "#define A 1 /* b\n c */ + 2\nint d;\n",
                   "#define A 1   + 2\n\nint d;\n"},
        CommentRow{"amid_a_joined_directive", "#define A \\\n/* b\n*/ 2\nint d;\n",
                   "#define A   2\n\n\nint d;\n"},
        CommentRow{"twice_amid_a_line", "int a; /*\n*/ int /*\n*/ b;\nint c;\n",
                   "int a;\n   int\n   b;\nint c;\n"},
        CommentRow{"amid_a_line_before_a_hash", "int a; /*\n*/ #define B\nint c;\n",
                   "int a;   #define B\n\nint c;\n"},
        CommentRow{"before_a_directive", "/* a\n*/ #define B\n", "\n   #define B\n"},
        CommentRow{"of_comments", "/**//*/ /* // */ int a; //* b\nint c; // /*\nint d;\n",
                   "                 int a;\nint c;\nint d;\n"},
        CommentRow{"at_the_end", "int a; // b", "int a;\n"},
        CommentRow{"with_windows_line_ends", "int a; // b\r\n/* c\r\n */\r\n#define A \\\r\n 1\r\n",
                   "int a;\n\n\n#define A  1\n\n"},
        CommentRow{"with_old_line_ends", "int a; // b\rint c;\r/* d\r*/\rint e;",
                   "int a;\nint c;\n\n\nint e;\n"},
        CommentRow{"with_line_ends_the_other_way", "int a; // b\n\rint c;\n\r", "int a;\nint c;\n"},
        CommentRow{"with_a_form_feed", "int a;\f// b\v\nint\vc;\n", "int a;\nint c;\n"},
        CommentRow{"behind_a_backslash", "#define A \\ // b\nint a;\n#define B \\ \nint c;\n",
                   "#define A \\ \nint a;\n#define B \\ \nint c;\n"},
        CommentRow{"that_takes_in_a_line", "int a; // b \\\nint c; // d\nint e;\n", "int a;\n\nint e;\n"},
        CommentRow{"that_takes_in_a_line_of_windows", "// b \\\r\nint c;\r\nint d;", "\n\nint d;\n"},
        CommentRow{"kept_to_a_line_by_a_blank", "// b \\ \nint c;\n", "\nint c;\n"},
        CommentRow{"begun_on_two_lines", "int a; /\\\n/ b\n// c\nint d;\n", "int a;\n\n\nint d;\n"},
        CommentRow{"ended_on_two_lines", "/* a *\\\n/ int b; /* */\nint c;\n", "        int b;\n\nint c;\n"},
        CommentRow{"joined_at_the_end_of_the_file", "int a; \\", "int a;\n"},
        CommentRow{"in_quotation_marks", "#error \"see // a\" b\nint c;\n", "#error  see\nint c;\n"},
        CommentRow{"behind_quotation_marks", "#error \"see\" // a\n", "#error \"see\"\n"},
        CommentRow{"with_a_quote", "int a; // don't \"b\n", "int a;\n"}),
    [](const auto& row) { return row.param.name; });

TEST(ScanPiece, KeepsCommentsThatNobodyCanMistake) {
    const ScannedPiece piece = scan_piece(
                                   "// a \\ \nint b; /* c\n d */\n#define E 1 /* f\n*/ + 2\n#error \"g // h\n"
                                   "int i; // j \\\nint k;\n",
                                   "a.glsl")
                                   .value();
    EXPECT_EQ(piece.text,
              "// a \\ \nint b; /* c\n d */\n#define E 1   + 2\n\n#error  g\nint i; // j int k;\n\n");
    EXPECT_EQ(piece.code, "\nint b;\n\n#define E 1   + 2\n\n#error  g\nint i;\n\n");
    ASSERT_EQ(piece.warnings.size(), 1u);
    EXPECT_EQ(to_text(piece.warnings.front()),
              "a.glsl:7: warning: this comment takes in the next line, since it ends in '\\'\n"
              "    int i; // j \\\n  help: write something behind the '\\'\n");
}

TEST(ScanPiece, MindsNoCommentThatTakesInNothing) {
    for (const char* text : {"// a \\\n\nint b;\n", "// a \\\n  // b\nint c;\n", "// a \\ \nint b;\n"})
        EXPECT_TRUE(scan_piece(text, "a.glsl").value().warnings.empty()) << text;
}

TEST(ScanPiece, TakesOutWhatTheComposerAnswers) {
    const ScannedPiece piece =
        scan_piece(
            "#pragma once\n# line 7 \"b\"\n#version 120\nint a;\n#line 3\n#extension GL_A : warn\n"
            "#ifdef B\n#extension GL_B : require\n#endif\n#pragma optimize(off)\n"
            "#extension GL_A:enable\n#extension odd\n#include <c>\n",
            "a.glsl")
            .value();
    EXPECT_EQ(piece.code,
              "\n\n\nint a;\n\n\n#ifdef B\n\n#endif\n#pragma optimize(off)\n\n#extension odd\n\n");
    EXPECT_TRUE(piece.is_once);
    EXPECT_EQ(piece.version, "120");
    ASSERT_EQ(piece.extensions.size(), 1u);
    EXPECT_EQ(piece.extensions.at("GL_A").behavior, "enable");
    EXPECT_EQ(piece.extensions.at("GL_A").place, (Place{"a.glsl", 11, 1}));
    std::vector<std::string> words;
    for (const Directive& directive : piece.directives) words.push_back(directive.word);
    EXPECT_THAT(words, testing::ElementsAre("ifdef", "extension", "endif", "include"));
}

TEST(ScanPiece, SeesGuardsAroundTheWholeFile) {
    const auto guard_of = [](const char* text) { return scan_piece(text, "a.glsl").value().guard; };
    EXPECT_EQ(guard_of("// a\n#ifndef A\n#define A\nint a;\n#ifdef B\n#else\n#endif\n#endif // A\n\n"), "A");
    EXPECT_EQ(guard_of("#pragma once\n#version 330\n#ifndef A\n#define A\n#endif\n"), "A");
    EXPECT_EQ(guard_of("#ifndef A\n#endif\nint a;\n"), "");
    EXPECT_EQ(guard_of("int a;\n#ifndef A\n#endif\n"), "");
    EXPECT_EQ(guard_of("#ifndef A\n#else\n#endif\n"), "");
    EXPECT_EQ(guard_of("#ifndef A\n#endif\n#ifndef B\n#endif\n"), "");
    EXPECT_EQ(guard_of("#include <b>\n#ifndef A\n#endif\n"), "");
    EXPECT_EQ(guard_of("#ifdef A\n#endif\n"), "");
}

TEST(ScanPiece, TakesLongBlanks) {
    const std::string blanks(300'000, ' ');
    const std::string text = "layout(std140" + blanks + ") uniform /*" + blanks + "*/ A" + blanks +
                             "{ float a; };" + "BLOCK(" + blanks + "1, B)\n";
    const ScannedPiece piece = scan_piece(text, "a.glsl").value();
    EXPECT_THAT(piece.bindings, testing::ElementsAre(testing::Pair("B", 1)));
}

TEST(ScanPiece, ReadsWindowsLineEndsAndByteOrderMarks) {
    const ScannedPiece piece =
        scan_piece("\xEF\xBB\xBF#version 330 core\r\n#include <fog>\r\nint a;\r\n", "a.glsl").value();
    EXPECT_EQ(piece.version, "330 core");
    EXPECT_EQ(piece.text, "\n\nint a;\n");
    EXPECT_EQ(piece.includes.front().line, "#include <fog>");
}

TEST(ScanPiece, ReadsStatedBindings) {
    const ScannedPiece piece = scan_piece(
                                   "BLOCK(3, Fog) { float near; } fog;\nSAMPLER( 2 , sampler2D ) albedo;\n"
                                   "// BLOCK(4, Hidden)\n#define BLOCK(binding, name) uniform name\n",
                                   "a.glsl")
                                   .value();
    EXPECT_THAT(piece.bindings, testing::ElementsAre(testing::Pair("Fog", 3), testing::Pair("albedo", 2)));
}

TEST(ScanPiece, AllowsExtensionsAboveIncludes) {
    EXPECT_TRUE(scan_piece("#extension GL_ARB_gpu_shader5 : enable\n#include <fog>\n", "a.glsl"));
}

struct BadPieceRow {
    const char* name;
    std::string text;
    std::string message;
};

std::string times(int count, std::string_view text) {
    std::string result;
    for (int i = 0; i < count; ++i) result += text;
    return result;
}

BadPieceRow nested_statements(const char* name, std::string_view head) {
    const std::string text = times(2000, head) + "c;\n";
    return {name, text,
            "a.glsl:1: error: statements are nested more than 1000 deep, each `else if` counted\n    " +
                text.substr(0, 80) + "\n  help: split the expression or the function\n"};
}

class BadPiece : public testing::TestWithParam<BadPieceRow> {};

TEST_P(BadPiece, IsRefusedExactly) {
    const Result<ScannedPiece> piece = scan_piece(GetParam().text, "a.glsl");
    ASSERT_FALSE(piece);
    EXPECT_EQ(first_text(piece.error()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, BadPiece,
    testing::Values(
        BadPieceRow{"include_of_nothing", "#include\n",
                    "a.glsl:1:1: error: malformed #include\n    #include\n    ^\n"
                    "  help: write #include <feature> or #include \"folder/piece.glsl\"\n"},
        BadPieceRow{"include_half_closed", "#include \"a.glsl>\n",
                    "a.glsl:1:1: error: malformed #include\n    #include \"a.glsl>\n    ^\n"
                    "  help: write #include <feature> or #include \"folder/piece.glsl\"\n"},
        BadPieceRow{"version_of_another_language", "#version 450\r#version 1;system()//\r",
                    "a.glsl:2:1: error: GLSL has no #version '1;system()'\n    #version 1;system()//\n    ^\n"
                    "  help: write a number that GLSL has and the profile alone: 330 core, 450, 300 es\n"},
        BadPieceRow{
            "version_with_more", "#version 330 core int a;\n",
            "a.glsl:1:1: error: GLSL has no #version '330 core int a;'\n    #version 330 core int a;\n    ^\n"
            "  help: write a number that GLSL has and the profile alone: 330 core, 450, 300 es\n"},
        BadPieceRow{"version_twice", "#version 330\nint a;\n#version 450\n",
                    "a.glsl:3:1: error: a second #version beside 330\n    #version 450\n    ^\n"
                    "  help: state the version once\n"},
        BadPieceRow{"no_endif", "int a;\n#if A\n#ifdef B\n#endif\n",
                    "a.glsl:2:1: error: missing #endif: nothing ends this #if\n    #if A\n    ^\n"
                    "  help: write #endif in the same file, behind what the condition is for\n"},
        BadPieceRow{"no_endif_within", "#if A\n # ifndef B\n#endif\n",
                    "a.glsl:1:1: error: missing #endif: nothing ends this #if\n    #if A\n    ^\n"
                    "  help: write #endif in the same file, behind what the condition is for\n"},
        BadPieceRow{"no_if", "#if A\n#endif\n#endif\n",
                    "a.glsl:3:1: error: #endif without #if\n    #endif\n    ^\n"
                    "  help: begin and end a condition in the same file\n"},
        BadPieceRow{"two_elses", "#if A\n#else\n#elif B\n#endif\n",
                    "a.glsl:3:1: error: #elif behind the #else of line 2\n    #elif B\n    ^\n"
                    "  help: end the condition with #endif first\n"},
        BadPieceRow{"open_comment_on_a_joined_line", "int a; \\\n b /* c\nint d;\n",
                    "a.glsl:2: error: a comment has no end\n     b /* c\n  help: close it with */\n"},
        BadPieceRow{"open_comment_begun_in_quotation_marks", "#error \"/*\"\n",
                    "a.glsl:1: error: a comment has no end\n    #error \"/*\"\n  help: close it with */\n"},
        BadPieceRow{
            "open_comment", "int a;\nint b; /* c */ /* d\n\n",
            "a.glsl:2: error: a comment has no end\n    int b; /* c */ /* d\n  help: close it with */\n"},
        BadPieceRow{"nul_byte", std::string("int a;\n\0", 8),
                    "a.glsl:2: error: holds a NUL byte and is not text\n  help: name a GLSL file\n"},
        BadPieceRow{"nested_over_lines",
                    std::string(201, '\n') + std::string(150, '{') + "\n" + std::string(51, '{') + "\n",
                    "a.glsl:203: error: brackets are nested more than 200 deep\n"
                    "    {{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{\n"
                    "  help: split the expression or the function\n"},
        nested_statements("ifs_in_one_another", "if(a)"),
        nested_statements("loops_in_one_another", "for(;;)"), nested_statements("do_in_one_another", "do "),
        nested_statements("long_chain_of_else_if", "if(a)b;else "),
        BadPieceRow{"more_includes_than_a_stage_takes", "int a;\n" + times(10'001, "#include <b>\n"),
                    "a.glsl:10002:1: error: this file has more than 10000 #includes below its top\n"
                    "    #include <b>\n    ^\n"
                    "  help: include files at the top, or from one another\n"}),
    [](const auto& row) { return row.param.name; });

TEST(ScanPiece, TakesTheVersionsOfGlsl) {
    for (const char* version : {"100", "110", "120", "130", "140", "150", "150 core", "150 compatibility",
                                "330 core", "460", "300 es", "310   es", "320 es"})
        EXPECT_EQ(scan_piece(std::string("#version ") + version, "a").value().version, version);
    for (const char* version :
         {"", "1", "0", "450a", "450 es", "300", "300 core", "140 core", "330 Core", "-330", "0x14A",
          "330 core core", "450\x1b[31m", "450 \xE2\x80\xA8", "99999999999999999999", "4.5"})
        EXPECT_FALSE(scan_piece(std::string("#version ") + version, "a")) << version;
}

struct LongTextRow {
    const char* name;
    std::string text;
};

class LongText : public testing::TestWithParam<LongTextRow> {};

/// Processor time: a tenth of a second, some hundred times that where each line or comment looks at all those
/// before it.
TEST_P(LongText, IsReadInSeconds) {
    const std::clock_t start = std::clock();
    EXPECT_TRUE(scan_piece(GetParam().text, "a.glsl"));
    EXPECT_LT((std::clock() - start) / CLOCKS_PER_SEC, 10);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, LongText,
    testing::Values(LongTextRow{"conditions", times(150'000, "#if 1\n") + times(150'000, "#endif\n")},
                    LongTextRow{"branches", "#if 0\n" + times(300'000, "#elif 0\n") + "#endif\n"},
                    LongTextRow{"macros", times(300'000, "#define A 1\n")},
                    LongTextRow{"comments_on_one_line", times(1'500'000, "/**/")},
                    LongTextRow{"comments_that_take_in_lines", times(150'000, "// a\\\nb\n")},
                    LongTextRow{"words_behind_endif", times(150'000, "#if 1\n#endif A\n")},
                    LongTextRow{"semicolons", times(1'500'000, ";")},
                    LongTextRow{"blocks_without_layout", times(150'000, "uniform A{int a;};\n")}),
    [](const auto& row) { return row.param.name; });

TEST(ScanPiece, TakesStatementsThatAreEndedAgain) {
    for (const char* text : {"while (a) b;", "if (a) b; else c;", "do a; while (b);", "for (;;) { a; }",
                             "if (a) { b; } else if (c) { d; } e;", "case 1: case 2: default:"})
        EXPECT_TRUE(scan_piece(times(5000, text), "a.glsl")) << text;
}

TEST(ScanPiece, TakesDeepNestingThatIsClosedAgain) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "((()))";
    EXPECT_TRUE(scan_piece(text, "a.glsl"));
}

}  // namespace
}  // namespace gobo
