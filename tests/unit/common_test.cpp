#include <algorithm>
#include <atomic>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic.hpp"
#include "core/file_system.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/text_template.hpp"

namespace gobo {
namespace {

TEST(Diagnostic, PrintsPlaceMessageSubjectQuotationAndHelp) {
    Diagnostic diagnostic;
    diagnostic.place = {"shader_lib/fog/linear.glsl", 12, 5};
    diagnostic.message = "unknown function 'mxi'";
    diagnostic.subject = "fog=linear point=3";
    diagnostic.quoted_line = "\tvec mxi(1)";
    diagnostic.help = "did you mean 'mix'?";
    EXPECT_EQ(to_text(diagnostic),
              "shader_lib/fog/linear.glsl:12:5: error: unknown function 'mxi' [fog=linear point=3]\n"
              "    \tvec mxi(1)\n"
              "    \t   ^\n"
              "  help: did you mean 'mix'?\n");
}

TEST(Diagnostic, ExitStatusIsThatOfTheGravestFault) {
    const Diagnostics none;
    EXPECT_EQ(exit_status(none), 0);
    Diagnostics several(2);
    several[0].fault = Fault::file;
    several[1].fault = Fault::usage;
    EXPECT_EQ(exit_status(several), 3);
    several[0].severity = Severity::warning;
    EXPECT_EQ(exit_status(several), 2);
}

TEST(Text, FolderOfAPath) {
    EXPECT_EQ(folder_of("some/folder/tiny.toml"), "some/folder");
    EXPECT_EQ(folder_of("tiny.toml"), "");
    EXPECT_EQ(folder_of("/tiny.toml"), "/");
}

TEST(ParallelFor, CallsEachIndexOnce) {
    for (const int jobs : {1, 2, 7, 100}) {
        std::vector<std::atomic<int>> calls(20);
        parallel_for(jobs, calls.size(), [&](std::size_t i) { ++calls[i]; });
        EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](int count) { return count == 1; })) << jobs;
        parallel_for(jobs, 0, [&](std::size_t) { FAIL(); });
    }
}

TEST(Text, NearestNeedsFewEdits) {
    const std::vector<std::string> names = {"linear", "exponential", "exponential_squared"};
    EXPECT_EQ(nearest("linaer", names), "linear");
    EXPECT_EQ(nearest("exponental", names), "exponential");
    EXPECT_EQ(nearest("purple", names), std::nullopt);
}

TEST(DiskFileSystem, AFullDiskIsAnError) {
    DiskFileSystem files;
    const Result<bool> written = files.write("/dev/full", "some text");
    ASSERT_FALSE(written);
    EXPECT_EQ(to_text(written.error().front()),
              "/dev/full: error: cannot be written: No space left on device\n");
    EXPECT_EQ(exit_status(written.error()), 3);
}

TEST(TextTemplate, APlaceholderWithoutValueIsAFaultOfOurOwn) {
    const TextTemplate text_template{"header.hpp.in", "one {{known}}\ntwo {{unknown}}\n"};
    const auto text = fill(text_template, {{"known", "1"}});
    ASSERT_FALSE(text);
    EXPECT_EQ(to_text(text.error().front()),
              "header.hpp.in:2: error: the placeholder 'unknown' has no value\n"
              "    two {{unknown}}\n");
    EXPECT_EQ(exit_status(text.error()), 4);
}

}  // namespace
}  // namespace gobo
