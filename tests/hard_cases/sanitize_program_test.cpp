// `gobo sanitize` on shader files, as a user runs it: textbook formulas are flagged at their lines with exit
// status 1, harmless ones are not, with exit status 0.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/file_system.hpp"
#include "plain_shaders.hpp"

namespace gobo {
namespace {

struct Ran {
    int status = -1;
    std::string output;  ///< of both streams
};

Ran sanitize_file(const std::string& path) {
    const std::string folder =
        testing::TempDir() + "gobo_sanitize_" + std::filesystem::path(path).filename().string();
    const std::string log = folder + ".log";
    const std::string command = fmt::format("'{}/gobo' sanitize '{}' --points 1024 -o '{}' > '{}' 2>&1",
                                            GOBO_PROGRAM_FOLDER, path, folder, log);
    const int status = std::system(command.c_str());
    const Result<std::string> output = DiskFileSystem().read(log);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output ? *output : ""};
}

class SanitizedFile : public testing::TestWithParam<std::string> {};

TEST_P(SanitizedFile, IsFlaggedExactlyAtItsMarks) {
    const Lines marked = marked_lines(GetParam());
    const Ran ran = sanitize_file(GetParam());
    EXPECT_EQ(ran.status, marked.empty() ? 0 : 1) << ran.output;
    for (const std::string& line : marked) {  // "7: division by zero"
        const auto colon = line.find(':');
        const std::string told =
            fmt::format("{}:{}: error:{}", GetParam(), line.substr(0, colon), line.substr(colon + 1));
        EXPECT_NE(ran.output.find(told), std::string::npos) << told << "\nis not in\n" << ran.output;
    }
    EXPECT_NE(ran.output.find(fmt::format(", {} findings\n", marked.size())), std::string::npos)
        << ran.output;
}

std::vector<std::string> all_shaders() {
    std::vector<std::string> paths = shader_files("hard_cases/plain");
    const std::vector<std::string> harmless = shader_files("hard_cases/harmless");
    paths.insert(paths.end(), harmless.begin(), harmless.end());
    return paths;
}

INSTANTIATE_TEST_SUITE_P(Files, SanitizedFile, testing::ValuesIn(all_shaders()), file_test_name);

}  // namespace
}  // namespace gobo
