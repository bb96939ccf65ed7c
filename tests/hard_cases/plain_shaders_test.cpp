// Shaders as textbooks have them are flagged at the lines that say so ("// trap: message", "// so: message"
// for what follows), and nowhere else; where nothing undefined happens but the result is wrong, it is as
// wrong as its line says. Harmless ones are not flagged at all.
#include "plain_shaders.hpp"

#include <gtest/gtest.h>

#include "core/file_system.hpp"

namespace gobo {
namespace {

class ShaderFileTest : public testing::TestWithParam<std::string> {};
class PlainShader : public ShaderFileTest {};
class HarmlessShader : public ShaderFileTest {};

TEST_P(PlainShader, IsFlaggedAtItsMarks) {
    const Result<std::string> source = DiskFileSystem().read(GetParam());
    ASSERT_TRUE(source);
    const Lines marked = marked_lines(GetParam());
    ASSERT_FALSE(marked.empty() && wrong_marks(*source).empty());
    const sanitize::SanitizeReport report = sanitized_file(GetParam(), {});
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(found_lines(report), marked);
    EXPECT_EQ(consequences(report), following_lines(*source));
}

/// What is only inexact is right in double precision; what is wrong by its formula is not.
TEST_P(PlainShader, IsAsWrongAsItsMarksSay) {
    for (const WrongMark& mark : wrong_marks(*DiskFileSystem().read(GetParam()))) {
        EXPECT_EQ(number_text(result_of(GetParam(), mark.inputs, false)), mark.plain) << mark.at;
        EXPECT_NE(mark.plain, mark.right) << mark.at;
        const std::string exact = number_text(result_of(GetParam(), mark.inputs, true));
        if (mark.is_inexact)
            EXPECT_EQ(exact, mark.right) << mark.at;
        else
            EXPECT_NE(exact, mark.right) << mark.at;
    }
}

TEST_P(HarmlessShader, IsNotFlagged) {
    const sanitize::SanitizeReport report = sanitized_file(GetParam(), {});
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(found_lines(report), Lines{});
    EXPECT_GT(report.points, 0U);
}

/// The input file that a finding comes with makes it happen again, by itself.
TEST_P(PlainShader, NamesAnInputThatShowsIt) {
    const sanitize::SanitizeReport report = sanitized_file(GetParam(), {});
    EXPECT_EQ(not_replayed(GetParam(), *DiskFileSystem().read(GetParam()), report), Lines{});
}

INSTANTIATE_TEST_SUITE_P(Files, PlainShader, testing::ValuesIn(shader_files("hard_cases/plain")),
                         file_test_name);
INSTANTIATE_TEST_SUITE_P(Files, HarmlessShader, testing::ValuesIn(shader_files("hard_cases/harmless")),
                         file_test_name);

}  // namespace
}  // namespace gobo
