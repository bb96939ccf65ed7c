// Every link of the documentation to a file of the sources, or to a heading, leads somewhere.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "page.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;

/// The name by which a heading is linked: lower case, blanks as '-', without punctuation.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char character : heading) {
        const auto letter = static_cast<unsigned char>(character);
        if (std::isalnum(letter) != 0 || character == '_' || character == '-')
            anchor += static_cast<char>(std::tolower(letter));
        if (character == ' ') anchor += '-';
    }
    return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
    static const std::regex heading(R"(#+ (.*))");
    std::set<std::string> anchors;
    for (const std::string& line : lines_of(text_of_file(page))) {
        std::smatch match;
        if (std::regex_match(line, match, heading)) anchors.insert(anchor_of(match[1]));
    }
    return anchors;
}

/// The targets of `[text](target)` that are no addresses of other sites.
std::vector<std::string> links_of(const fs::path& page) {
    static const std::regex link(R"(\]\(([^)\s]+)\))");
    std::vector<std::string> links;
    for (const std::string& line : lines_of(text_of_file(page))) {
        for (std::sregex_iterator at(line.begin(), line.end(), link), end; at != end; ++at) {
            if ((*at)[1].str().find("://") == std::string::npos) links.push_back((*at)[1]);
        }
    }
    return links;
}

std::vector<fs::path> pages() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(GOBO_SOURCE_DIR "/docs"))
        if (entry.path().extension() == ".md") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    for (const char* const page :
         {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "examples/teapot/README.md"})
        found.push_back(fs::path(GOBO_SOURCE_DIR) / page);
    return found;
}

TEST(Links, LeadToFilesAndHeadings) {
    std::size_t followed = 0;
    for (const fs::path& page : pages()) {
        for (const std::string& link : links_of(page)) {
            const auto hash = link.find('#');
            const std::string file = link.substr(0, hash);
            const fs::path target = file.empty() ? page : page.parent_path() / file;
            ++followed;
            ASSERT_TRUE(fs::exists(target)) << page << " links to " << link;
            if (hash == std::string::npos) continue;
            EXPECT_TRUE(anchors_of(target).contains(link.substr(hash + 1))) << page << " links to " << link;
        }
    }
    EXPECT_GT(followed, 20U) << "the pages link to each other more than that";
}

/// Paths of the sources in code, `tools/lab/oracle/`, but not those with a placeholder,
/// `data/study/NAME.csv`.
std::vector<std::string> paths_of(const fs::path& page) {
    static const std::regex path(
        "`((?:tools|tests|data|shader_lib|include|examples|templates|cmake|docs)/[a-z0-9_./]+)`");
    std::vector<std::string> paths;
    for (const std::string& line : lines_of(text_of_file(page))) {
        const std::string text = line.substr(std::min(line.find_first_not_of(' '), line.size()));
        if (text.starts_with("File `")) continue;  // written by the reader
        for (std::sregex_iterator at(line.begin(), line.end(), path), end; at != end; ++at)
            paths.push_back((*at)[1]);
    }
    return paths;
}

TEST(Links, PathsInCodeNameFilesThatExist) {
    int checked = 0;
    for (const fs::path& page : pages()) {
        for (const std::string& path : paths_of(page)) {
            EXPECT_TRUE(fs::exists(fs::path(GOBO_SOURCE_DIR) / path)) << page << " names " << path;
            ++checked;
        }
    }
    EXPECT_GT(checked, 20);
}

TEST(Links, OfTheArchitectureNameFoldersThatExist) {
    static const std::regex row(R"(\| `([a-z_/]+/)` \|.*)");
    int folders = 0;
    for (const std::string& line : lines_of(text_of_file(GOBO_SOURCE_DIR "/docs/architecture.md"))) {
        std::smatch match;
        if (!std::regex_match(line, match, row)) continue;
        ++folders;
        EXPECT_TRUE(fs::is_directory(fs::path(GOBO_SOURCE_DIR) / match[1].str())) << line;
    }
    EXPECT_GT(folders, 10) << "the table of folders has been rewritten";
}

}  // namespace
}  // namespace gobo
