// Which folder of tools/ may include which: tools/CMakeLists.txt says so, and every #include keeps to it.
// What all compilers take.
#include <map>
#include <regex>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/file_system.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

const std::string kTools = GOBO_SOURCE_DIR "/tools";

/// Each folder with those after USES, from the calls of gobo_folder().
std::map<std::string, std::set<std::string>> allowed_includes() {
    const std::string text = DiskFileSystem().read(kTools + "/CMakeLists.txt").value();
    std::map<std::string, std::set<std::string>> allowed;
    const std::regex call(R"(\ngobo_folder\(([^)]*)\))");
    for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at) {
        std::string arguments = (*at)[1];
        for (char& character : arguments)
            if (character == '\n') character = ' ';
        const std::vector<std::string> words = split(arguments, ' ');
        std::set<std::string>& uses = allowed[words.front()];
        uses.insert(words.front());
        bool is_use = false;
        for (const std::string& word : words) {
            if (is_use && word != "LINK" && word != "PRECOMPILE" && word != "OPTIONS") uses.insert(word);
            if (word == "USES") is_use = true;
            if (word == "LINK" || word == "PRECOMPILE" || word == "OPTIONS") is_use = false;
        }
    }
    return allowed;
}

std::string folder_of_file(const std::string& path) {
    return path.substr(0, path.rfind('/'));
}

/// "study/a.cpp includes lab/render/b.hpp" for each #include that the list does not allow.
std::vector<std::string> forbidden_includes() {
    const auto allowed = allowed_includes();
    const std::regex include(R"(^\s*#\s*include\s+"([^"]+)\")");
    std::vector<std::string> found;
    const DiskFileSystem disk;
    for (const std::string& file : disk.files_below(kTools)) {
        if ((!file.ends_with(".cpp") && !file.ends_with(".hpp")) || file.find("/glad/") != std::string::npos)
            continue;
        const std::string folder = folder_of_file(file);
        const auto uses = allowed.find(folder);
        if (uses == allowed.end()) {
            found.push_back(file + " lies in a folder that tools/CMakeLists.txt does not list");
            continue;
        }
        for (const std::string& line : split(disk.read(kTools + "/" + file).value(), '\n')) {
            if (line.find("#include <glslang/MachineIndependent/") != std::string::npos)
                found.push_back(file + " includes a header that Debian 13 does not package");
            std::smatch match;
            if (!std::regex_search(line, match, include)) continue;
            const std::string included = match[1];
            if (!uses->second.contains(folder_of_file(included)))
                found.push_back(fmt::format("{} includes {}", file, included));
        }
    }
    return found;
}

TEST(House, EveryIncludeIsOneThatTheListAllows) {
    EXPECT_THAT(forbidden_includes(), testing::IsEmpty());
}

TEST(House, TheCompilerNeverIncludesTheLab) {
    for (const auto& [folder, uses] : allowed_includes()) {
        if (folder.starts_with("lab/")) continue;
        for (const std::string& use : uses)
            EXPECT_FALSE(use.starts_with("lab/")) << folder << " uses " << use;
    }
}

TEST(House, TheListNamesTheFoldersThatThereAre) {
    const auto allowed = allowed_includes();
    EXPECT_TRUE(allowed.contains("family"));
    EXPECT_TRUE(allowed.contains("lab/evaluate"));
    EXPECT_GT(allowed.size(), 15U);
}

/// What returns a subrange does not compile with clang 14 and the library of g++ 12.
TEST(House, UsesNoAlgorithmThatClang14CannotCompile) {
    const std::regex call(
        "std::(views|ranges::(unique|(stable_)?partition|remove(_if)?|equal_range|rotate|"
        "search|find_end|subrange))\\b");
    const DiskFileSystem disk;
    for (const std::string folder : {"tools", "tests", "examples"})
        for (const std::string& file : disk.files_below(GOBO_SOURCE_DIR "/" + folder)) {
            if (!file.ends_with(".cpp") && !file.ends_with(".hpp")) continue;
            const std::string text = disk.read(GOBO_SOURCE_DIR "/" + folder + "/" + file).value();
            std::smatch match;
            EXPECT_FALSE(std::regex_search(text, match, call))
                << folder << "/" << file << ": " << match.str();
        }
}

}  // namespace
}  // namespace gobo
