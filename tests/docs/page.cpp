#include "page.hpp"

#include <algorithm>
#include <fstream>
#include <regex>

#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::string_view fence = "```";
constexpr std::string_view anything = "...";

std::string without_indentation(std::string_view line, std::size_t indentation) {
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    return std::string(line.substr(std::min(blanks, indentation)));
}

/// The path in "File `PATH`:" or "In `PATH`:"; empty for any other line.
std::string file_named_by(const std::string& line) {
    static const std::regex pattern(R"(\s*(?:File|In) `([^`]+)`:\s*)");
    std::smatch match;
    return std::regex_match(line, match, pattern) ? match[1].str() : "";
}

bool is_line_as_shown(std::string_view shown, std::string_view actual) {
    const auto gap = shown.find(anything);
    if (gap == std::string_view::npos) return shown == actual;
    if (!actual.starts_with(shown.substr(0, gap))) return false;
    const std::string_view rest = shown.substr(gap + anything.size());
    for (std::size_t at = gap; at <= actual.size(); ++at)
        if (is_line_as_shown(rest, actual.substr(at))) return true;
    return false;
}

using Lines = std::vector<std::string>;

bool matches(Lines::const_iterator shown, Lines::const_iterator shown_end, Lines::const_iterator actual,
             Lines::const_iterator actual_end) {
    if (shown == shown_end) return actual == actual_end;
    if (*shown == anything) {
        for (auto at = actual;; ++at) {
            if (matches(shown + 1, shown_end, at, actual_end)) return true;
            if (at == actual_end) return false;
        }
    }
    return actual != actual_end && is_line_as_shown(*shown, *actual) &&
           matches(shown + 1, shown_end, actual + 1, actual_end);
}

}  // namespace

std::string text_of_file(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::vector<PageBlock> blocks_of(std::string_view markdown) {
    std::vector<PageBlock> blocks;
    const Lines lines = lines_of(markdown);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t indentation = lines[i].find_first_not_of(' ');
        if (!trim(lines[i]).starts_with(fence)) continue;
        PageBlock block;
        block.language = trim(trim(lines[i]).substr(fence.size()));
        block.file = i > 0 ? file_named_by(lines[i - 1]) : "";
        block.line = static_cast<int>(i) + 1;
        for (++i; i < lines.size() && trim(lines[i]) != fence; ++i)
            block.text += without_indentation(lines[i], indentation) + "\n";
        blocks.push_back(std::move(block));
    }
    return blocks;
}

int stated_status(const PageBlock& commands) {
    static const std::regex pattern(R"(# exit status (\d))");
    std::smatch match;
    return std::regex_search(commands.text, match, pattern) ? std::stoi(match[1]) : 0;
}

bool is_as_shown(std::string_view shown, std::string_view actual) {
    const Lines shown_lines = lines_of(shown);
    const Lines actual_lines = lines_of(actual);
    return matches(shown_lines.begin(), shown_lines.end(), actual_lines.begin(), actual_lines.end());
}

}  // namespace gobo
