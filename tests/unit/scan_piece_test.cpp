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
    EXPECT_EQ(piece.text, "// head\n\n\n\n\nfloat f() { return 1.0; }\n") << "with a newline at its end";
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
        BadPieceRow{"renaming_without_a_name", "#include \"a.glsl\" with one as\n",
                    "a.glsl:1:1: error: malformed renaming\n    #include \"a.glsl\" with one as\n    ^\n"
                    "  help: write #include \"folder/piece.glsl\" with name as otherName, ...\n"},
        BadPieceRow{"nul_byte", std::string("int a;\n\0", 8),
                    "a.glsl:2: error: holds a NUL byte and is no text\n  help: name a GLSL file\n"},
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
