#include "case_file.hpp"

namespace gobo {
namespace {

constexpr std::string_view heading = "---- ";
constexpr std::string_view prompt = "$ ";

std::string_view take_line(std::string_view& text) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

}  // namespace

CaseFile read_case(std::string_view text) {
    CaseFile file;
    std::string* part = &file.summary;
    while (!text.empty()) {
        const std::string_view line = take_line(text);
        if (line.starts_with(prompt) && part == &file.summary) {
            file.command = line.substr(prompt.size());
            part = &file.command;
        } else if (line.starts_with("---- exit ")) {
            part = &file.answer;
            *part = std::string(line.substr(heading.size())) + "\n";
        } else if (line.starts_with(heading)) {
            part = &file.files.emplace_back(line.substr(heading.size()), "").second;
        } else {
            *part += std::string(line) + "\n";
        }
    }
    return file;
}

std::string case_text(const CaseFile& file) {
    std::string text = file.summary + std::string(prompt) + file.command + "\n";
    for (const auto& [path, content] : file.files) text += std::string(heading) + path + "\n" + content;
    return text + std::string(heading) + file.answer;
}

}  // namespace gobo
