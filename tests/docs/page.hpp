// A page of the documentation as the steps that a reader would take.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// A fenced block of a page.
struct PageBlock {
    std::string language;  ///< "sh", "text", "toml", ...
    std::string file;      ///< where the line above reads "File `PATH`:" or "In `PATH`:"
    std::string text;      ///< without the fence's own indentation
    int line = 0;          ///< of the opening fence, from 1
};

/// The whole text of a file; empty where there is none.
[[nodiscard]] std::string text_of_file(const std::filesystem::path& path);

/// The lines of a text, without their ends; blank ones too.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);

/// The fenced blocks of a page in Markdown, in order. Those within lists may be indented.
[[nodiscard]] std::vector<PageBlock> blocks_of(std::string_view markdown);

/// The exit status that a block of commands states in a comment, `# exit status 1`; otherwise 0.
[[nodiscard]] int stated_status(const PageBlock& commands);

/// Whether `actual` is what the page shows. A line `...` stands for any lines, `...` within a line for
/// any text.
[[nodiscard]] bool is_as_shown(std::string_view shown, std::string_view actual);

}  // namespace gobo
