#include "reader.hpp"

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/text.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;

/// No command of the documentation takes longer on a slow machine, with sanitizers.
constexpr int longest_seconds = 240;

fs::path new_folder() {
    std::string pattern = (fs::temp_directory_path() / "gobo_docs_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    return fs::canonical(pattern);
}

/// The lines of a diff that are in the file before (' ' and '-'), or after (' ' and '+').
std::string side_of(const std::string& diff, char sign) {
    std::string side;
    for (const std::string& line : lines_of(diff)) {
        if (!line.empty() && (line[0] == ' ' || line[0] == sign)) side += line.substr(1) + "\n";
    }
    return side;
}

}  // namespace

Reader::Reader(const fs::path& gobo)
    : own_(new_folder()), current_(own_ / "home"), gobo_folder_(gobo.parent_path().string()) {
    fs::create_directory(current_);
}

Reader::~Reader() {
    std::error_code ignored;
    fs::remove_all(own_, ignored);
}

void Reader::write(const PageBlock& block) {
    const fs::path path = current_ / block.file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << block.text;
}

std::string Reader::edit(const PageBlock& block) {
    const fs::path path = current_ / block.file;
    std::string text = text_of_file(path);
    const std::string before = side_of(block.text, '-');
    const auto at = text.find(before);
    if (before.empty() || at == std::string::npos)
        return fmt::format("{} has not these lines:\n{}", block.file, before);
    if (text.find(before, at + 1) != std::string::npos)
        return fmt::format("{} has these lines twice:\n{}", block.file, before);
    text.replace(at, before.size(), side_of(block.text, '+'));
    std::ofstream(path) << text;
    return {};
}

CommandResult Reader::run(const std::string& commands) {
    const fs::path script = own_ / "commands.sh";
    const fs::path printed = own_ / "printed";
    const fs::path folder = own_ / "folder";
    std::ofstream(script) << fmt::format("cd '{}'\ntrap 'pwd > {}' EXIT\n{}", current_.string(),
                                         folder.string(), commands);
    const std::string line =
        fmt::format("PATH='{}':\"$PATH\" timeout {} bash -eu -o pipefail '{}' > '{}' 2>&1 < /dev/null",
                    gobo_folder_, longest_seconds, script.string(), printed.string());
    const int status = std::system(line.c_str());
    current_ = std::string(trim(text_of_file(folder)));
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of_file(printed)};
}

}  // namespace gobo
