// Runs every case of tests/errors/cases through the executable and compares exit status and standard error.
// With GOBO_UPDATE=1 in the environment the answers are written anew instead; the difference is then git's to
// show.
#include <array>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "case_file.hpp"
#include "core/file_system.hpp"

namespace gobo {
namespace {

const std::string cases_folder = GOBO_SOURCE_DIR "/tests/errors/cases";

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const std::string& file : DiskFileSystem().files_below(cases_folder))
        names.push_back(file.substr(0, file.find('.')));
    return names;
}

/// A new folder that goes away with the object.
class ScratchFolder {
  public:
    ScratchFolder() { path_ = ::mkdtemp(path_.data()); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_ = "/tmp/gobo_errors_XXXXXX";
};

/// Runs a shell command in the folder, with gobo first on the path: "exit N" and what standard error got.
std::string answer_of(const std::string& command, const std::string& folder) {
    const std::string line =
        fmt::format("cd {} && export PATH={}:$PATH LC_ALL=C && ( {}\n ) 2>&1 >standard_output", folder,
                    GOBO_PROGRAM_FOLDER, command);
    FILE* pipe = ::popen(line.c_str(), "r");
    std::string messages;
    std::array<char, 4096> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        messages.append(buffer.data(), count);
    const int status = ::pclose(pipe);
    const std::string ended = WIFEXITED(status) ? std::to_string(WEXITSTATUS(status)) : "by a signal";
    return fmt::format("exit {}\n{}", ended, messages);
}

class Errors : public testing::TestWithParam<std::string> {};

TEST_P(Errors, AreAnsweredExactly) {
    DiskFileSystem disk;
    const std::string path = fmt::format("{}/{}.txt", cases_folder, GetParam());
    CaseFile file = read_case(disk.read(path).value());
    const ScratchFolder folder;
    for (const auto& [name, text] : file.files) ASSERT_TRUE(disk.write(folder.path() + "/" + name, text));
    const std::string answer =
        answer_of(file.command.substr(0, file.command.find_last_not_of('\n') + 1), folder.path());
    if (std::getenv("GOBO_UPDATE") != nullptr) {
        file.answer = answer;
        ASSERT_TRUE(disk.write(path, case_text(file)));
    }
    EXPECT_EQ(answer, file.answer) << path << "\n" << file.summary;
}

INSTANTIATE_TEST_SUITE_P(Cases, Errors, testing::ValuesIn(case_names()),
                         [](const auto& row) { return row.param; });

/// So that a case cannot be lost by a wrong folder or heading.
TEST(Errors, AreManyAndEachHasAnAnswer) {
    const std::vector<std::string> names = case_names();
    EXPECT_GE(names.size(), 25u);
    for (const std::string& name : names) {
        const CaseFile file =
            read_case(DiskFileSystem().read(fmt::format("{}/{}.txt", cases_folder, name)).value());
        EXPECT_FALSE(file.summary.empty() || file.command.empty()) << name;
        EXPECT_TRUE(file.answer.starts_with("exit ")) << name;
    }
}

}  // namespace
}  // namespace gobo
