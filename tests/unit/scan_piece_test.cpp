// What the composer reads of one file.
#include "compose/scan_piece.hpp"

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
    EXPECT_TRUE(piece.includes[0].of_feature);
    EXPECT_EQ(piece.includes[0].target, "fog");
    EXPECT_EQ(piece.includes[0].place, (Place{"a.glsl", 3, 3}));
    EXPECT_EQ(piece.includes[0].line, "  # include  <fog>");
    EXPECT_FALSE(piece.includes[1].of_feature);
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
    EXPECT_THAT(piece.identifiers, testing::ElementsAre("int", "seen"));
}

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
        CommentRow{"amid_a_directive_over_lines", "#define A 1 /* b\n c */ + 2\n",
                   "#define A 1 /*\n   */ + 2\n"},
        CommentRow{"amid_a_joined_directive", "#define A \\\n/* b\n*/ 2\n", "#define A \\\n/*\n*/ 2\n"},
        CommentRow{"of_comments", "/**//*/ /* // */ int a; //* b\nint c; // /*\nint d;\n",
                   "                 int a;\nint c;\nint d;\n"},
        CommentRow{"at_the_end", "int a; // b", "int a;\n"},
        CommentRow{"with_windows_line_ends", "int a; // b\r\n/* c\r\n */\r\n#define A \\\r\n 1\r\n",
                   "int a;\n\n\n#define A \\\n 1\n"},
        CommentRow{"with_old_line_ends", "int a; // b\rint c;\n", "int a;     \rint c;\n"},
        CommentRow{"behind_a_backslash", "#define A \\ // b\nint a;\n#define B \\ \nint c;\n",
                   "#define A \\ \nint a;\n#define B \\ \nint c;\n"},
        CommentRow{"that_may_go_on", "int a; // b \\\nint c; // d\n", "int a; // b \\\nint c; // d\n"},
        CommentRow{"that_may_go_on_windows", "// b \\\r\nint c;\n", "// b \\\nint c;\n"},
        CommentRow{"begun_on_two_lines", "int a; /\\\n/ b\n// c\n", "int a; /\\\n/ b\n// c\n"},
        CommentRow{"ended_on_two_lines", "/* a *\\\n/ int b; /* */\n", "/* a *\\\n/ int b; /* */\n"},
        CommentRow{"that_may_be_a_string", "#error \"see // a\" b\n", "#error \"see // a\" b\n"},
        CommentRow{"with_a_quote", "int a; // don't \"b\n", "int a;\n"}),
    [](const auto& row) { return row.param.name; });

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
    const char* message;
};

class BadPiece : public testing::TestWithParam<BadPieceRow> {};

TEST_P(BadPiece, IsRefusedExactly) {
    const Result<ScannedPiece> piece = scan_piece(GetParam().text, "a.glsl");
    ASSERT_FALSE(piece);
    EXPECT_EQ(first_text(piece.error()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, BadPiece,
    testing::Values(
        BadPieceRow{"include_after_code", "int a;\n\t#include <fog>\n",
                    "a.glsl:2:2: error: #include after code\n    \t#include <fog>\n    \t^\n"
                    "  help: includes stand at the top of a piece, after comments only\n"},
        BadPieceRow{"include_within_condition", "#if A\n#include <fog>\n#endif\n",
                    "a.glsl:2:1: error: #include after code\n    #include <fog>\n    ^\n"
                    "  help: includes stand at the top of a piece, after comments only\n"},
        BadPieceRow{"include_of_nothing", "#include\n",
                    "a.glsl:1:1: error: malformed #include\n    #include\n    ^\n"
                    "  help: write #include <feature> or #include \"folder/piece.glsl\"\n"},
        BadPieceRow{"include_half_closed", "#include \"a.glsl>\n",
                    "a.glsl:1:1: error: malformed #include\n    #include \"a.glsl>\n    ^\n"
                    "  help: write #include <feature> or #include \"folder/piece.glsl\"\n"},
        BadPieceRow{"include_of_no_feature", "#include <fog linear>\n",
                    "a.glsl:1:1: error: malformed #include\n    #include <fog linear>\n    ^\n"
                    "  help: write #include <feature> or #include \"folder/piece.glsl\"\n"},
        BadPieceRow{
            "open_comment", "int a;\nint b; /* c */ /* d\n\n",
            "a.glsl:2: error: a comment has no end\n    int b; /* c */ /* d\n  help: close it with */\n"},
        BadPieceRow{"nul_byte", std::string("int a;\n\0", 8),
                    "a.glsl:2: error: holds a NUL byte and is not text\n  help: name a GLSL file\n"},
        BadPieceRow{"nested_over_lines",
                    std::string(201, '\n') + std::string(150, '{') + "\n" + std::string(51, '{') + "\n",
                    "a.glsl:203: error: brackets are nested more than 200 deep\n"
                    "    {{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{\n"
                    "  help: split the expression or the function\n"}),
    [](const auto& row) { return row.param.name; });

TEST(ScanPiece, TakesDeepNestingThatIsClosedAgain) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "((()))";
    EXPECT_TRUE(scan_piece(text, "a.glsl"));
}

}  // namespace
}  // namespace gobo
