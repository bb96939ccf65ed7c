// Shaders as textbooks have them are flagged at the lines that say so ("// trap: message", "// so: message"
// for what follows), and nowhere else; where nothing undefined happens but the result is wrong, it is as
// wrong as its line says. Harmless ones are not flagged at all.
#include "plain_shaders.hpp"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/sanitize/bounds.hpp"
#include "lab/sanitize/sanitize.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// "linear_fog_frag".
std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = std::filesystem::path(info.param).filename().string();
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

class ShaderFileTest : public testing::TestWithParam<std::string> {};
class PlainShader : public ShaderFileTest {};
class HarmlessShader : public ShaderFileTest {};

TEST_P(PlainShader, IsFlaggedAtItsMarks) {
    const Result<std::string> source = DiskFileSystem().read(GetParam());
    ASSERT_TRUE(source);
    const Lines marked = marked_lines(*source);
    ASSERT_FALSE(marked.empty() && wrong_marks(*source).empty());
    const sanitize::SanitizeReport report = report_of(GetParam());
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
    const sanitize::SanitizeReport report = report_of(GetParam());
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(found_lines(report), Lines{});
    EXPECT_GT(report.points, 0U);
}

/// The input file that a finding comes with makes it happen again, by itself.
TEST_P(PlainShader, NamesAnInputThatShowsIt) {
    const sanitize::SanitizeReport report = report_of(GetParam());
    const DiskFileSystem disk;
    SearchPath search;
    const Result<Family> family = family_of_files({GetParam()}, disk, search);
    const Result<Composition> composition = compose(*family, {Key{}}, search, Dialect::own);
    ValidateOptions options;
    options.keep_spirv = true;
    options.debug_information = true;
    const Validated validated = validate(*family, *composition, options);
    const Result<evaluate::Program> program = evaluate::decode(validated.stages.front().spirv);
    ASSERT_TRUE(program);
    for (const sanitize::SharedFinding& shared : report.findings) {
        const auto inputs = evaluate::read_eval_inputs(eval_input(shared.finding, "an input"), "found.toml");
        ASSERT_TRUE(inputs) << to_text(inputs.error().front());
        const auto invocations = evaluate::invocations_of(*inputs, *program);
        ASSERT_TRUE(invocations) << to_text(invocations.error().front());
        const sanitize::InputSpace space = sanitize::input_space_of(*program, {}, true);
        const sanitize::PointSet point = sanitize::point_set(space, shared.finding.point);
        sanitize::OutputBounds bounds(*family, Key{}, composition->stages.front().kind, *program, space,
                                      sanitize::depth_promise_of(validated.stages.front().spirv));
        std::vector<sanitize::Interval> allowed = bounds.at(point);
        allowed.resize(allowed.size() / space.pixels * invocations->count);
        const auto alone = sanitize::find_traps(*program, *invocations, shared.finding.machine, allowed);
        ASSERT_TRUE(alone);
        EXPECT_TRUE(std::any_of(alone->begin(), alone->end(), [&](const sanitize::Finding& finding) {
            return finding.message == shared.finding.message && finding.place == shared.finding.place;
        })) << shared.finding.message;
    }
}

INSTANTIATE_TEST_SUITE_P(Files, PlainShader, testing::ValuesIn(shaders_in("plain")), test_name);
INSTANTIATE_TEST_SUITE_P(Files, HarmlessShader, testing::ValuesIn(shaders_in("harmless")), test_name);

}  // namespace
}  // namespace gobo
