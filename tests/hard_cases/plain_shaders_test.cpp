// Shaders as textbooks have them are flagged at the lines that say so ("// trap: message"), and nowhere else;
// harmless ones are not flagged at all.
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/file_system.hpp"
#include "common/text.hpp"
#include "compose/compose.hpp"
#include "compose/loose_files.hpp"
#include "evaluate/eval_inputs.hpp"
#include "sanitize/sanitize.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// "7: division by zero".
using Lines = std::set<std::string>;

Lines marked_lines(const std::string& source) {
    constexpr std::string_view kMark = "// trap: ";
    Lines lines;
    const auto count = std::count(source.begin(), source.end(), '\n');
    for (int number = 1; number <= count; ++number) {
        const std::string_view line = line_of(source, number);
        const auto mark = line.find(kMark);
        if (mark != std::string_view::npos)
            lines.insert(fmt::format("{}: {}", number, line.substr(mark + kMark.size())));
    }
    return lines;
}

struct ShaderFile {
    std::string path;
    std::string source;
};

sanitize::SanitizeReport report_of(const std::string& path) {
    const DiskFileSystem disk;
    SearchPath search;
    const Result<Family> family = family_of_files({path}, disk, search);
    EXPECT_TRUE(family) << path;
    const Result<Composition> composition = compose(*family, {Key{}}, search, Dialect::own);
    EXPECT_TRUE(composition) << path;
    ValidateOptions options;
    options.keep_spirv = true;
    options.debug_information = true;
    const Validated validated = validate(*family, *composition, options);
    EXPECT_EQ(exit_status(validated.diagnostics), 0) << path;
    return sanitize::sanitize(*family, *composition, validated, {});
}

std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> paths;
    const std::string whole = std::string(GOBO_SOURCE_DIR "/tests/hard_cases/") + folder;
    for (const auto& entry : std::filesystem::directory_iterator(whole))
        paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// "linear_fog_frag".
std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = std::filesystem::path(info.param).filename().string();
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

class ShaderFileTest : public testing::TestWithParam<std::string> {};
class PlainShader : public ShaderFileTest {};
class HarmlessShader : public ShaderFileTest {};

Lines found_lines(const sanitize::SanitizeReport& report) {
    Lines lines;
    for (const sanitize::SharedFinding& shared : report.findings)
        lines.insert(fmt::format("{}: {}", shared.finding.place.line, shared.finding.message));
    return lines;
}

TEST_P(PlainShader, IsFlaggedAtItsMarks) {
    const Result<std::string> source = DiskFileSystem().read(GetParam());
    ASSERT_TRUE(source);
    const Lines marked = marked_lines(*source);
    ASSERT_FALSE(marked.empty());
    const sanitize::SanitizeReport report = report_of(GetParam());
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(found_lines(report), marked);
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
        const auto alone = sanitize::find_traps(*program, *invocations, shared.finding.machine);
        ASSERT_TRUE(alone);
        EXPECT_TRUE(std::any_of(alone->begin(), alone->end(), [&](const sanitize::Finding& finding) {
            return finding.message == shared.finding.message && finding.place == shared.finding.place;
        })) << shared.finding.message;
    }
}

INSTANTIATE_TEST_SUITE_P(Files, PlainShader, testing::ValuesIn(files_in("plain")), test_name);
INSTANTIATE_TEST_SUITE_P(Files, HarmlessShader, testing::ValuesIn(files_in("harmless")), test_name);

}  // namespace
}  // namespace gobo
