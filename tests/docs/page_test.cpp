// How the test of the documentation reads a page: a page that is wrong must be found wrong.
#include "page.hpp"

#include <ostream>

#include <gtest/gtest.h>

namespace gobo {
namespace {

struct ShownCase {
    std::string name;
    std::string shown;
    std::string actual;
    bool is_as_shown;

    friend void PrintTo(const ShownCase& row, std::ostream* out) { *out << row.name; }
};

class Shown : public testing::TestWithParam<ShownCase> {};

TEST_P(Shown, IsComparedWithWhatWasPrinted) {
    EXPECT_EQ(is_as_shown(GetParam().shown, GetParam().actual), GetParam().is_as_shown);
}

INSTANTIATE_TEST_SUITE_P(
    Docs, Shown,
    testing::Values(ShownCase{"equal", "a\nb\n", "a\nb\n", true},
                    ShownCase{"other_text", "a\nb\n", "a\nc\n", false},
                    ShownCase{"line_too_few", "a\n", "a\nb\n", false},
                    ShownCase{"line_too_many", "a\nb\n", "a\n", false},
                    ShownCase{"nothing_shown", "", "a\n", false}, ShownCase{"nothing_printed", "", "", true},
                    ShownCase{"any_lines_between", "a\n...\nd\n", "a\nb\nc\nd\n", true},
                    ShownCase{"no_lines_between", "a\n...\nd\n", "a\nd\n", true},
                    ShownCase{"any_lines_then_another", "a\n...\nd\n", "a\nb\nc\n", false},
                    ShownCase{"rest_of_a_line", "a ...\nb\n", "a 12\nb\n", true},
                    ShownCase{"part_of_a_line", "a ... c\n", "a 12 c\n", true},
                    ShownCase{"part_of_another_line", "a ... c\n", "a 12 d\n", false},
                    ShownCase{"rest_of_another_line", "a ...\nb\n", "b 12\nb\n", false}),
    [](const auto& row) { return row.param.name; });

TEST(PageBlocks, KeepFileLanguageTextAndLine) {
    const std::vector<PageBlock> blocks = blocks_of(
        "1. Write it.\n"
        "\n"
        "   File `fog/a.glsl`:\n"
        "   ```glsl\n"
        "   void f() {\n"
        "       g();\n"
        "\n"
        "   }\n"
        "   ```\n"
        "```sh\n"
        "false  # exit status 1\n"
        "```\n");
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_EQ(blocks[0].language, "glsl");
    EXPECT_EQ(blocks[0].file, "fog/a.glsl");
    EXPECT_EQ(blocks[0].text, "void f() {\n    g();\n\n}\n");
    EXPECT_EQ(blocks[0].line, 4);
    EXPECT_EQ(blocks[1].language, "sh");
    EXPECT_EQ(blocks[1].file, "");
    EXPECT_EQ(stated_status(blocks[1]), 1);
}

}  // namespace
}  // namespace gobo
