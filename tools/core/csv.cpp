#include "core/csv.hpp"

#include <algorithm>

namespace gobo {
namespace {

/// Takes one line off the text.
std::vector<std::string> take_cells(std::string_view& text) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    std::size_t at = 0;
    for (; at < text.size(); ++at) {
        const char character = text[at];
        if (is_quoted && character == '"' && at + 1 < text.size() && text[at + 1] == '"') {
            cells.back() += '"';
            ++at;
        } else if (character == '"') {
            is_quoted = !is_quoted;
        } else if (character == ',' && !is_quoted) {
            cells.emplace_back();
        } else if (character == '\n' && !is_quoted) {
            break;
        } else if (character != '\r') {
            cells.back() += character;
        }
    }
    text.remove_prefix(std::min(at + 1, text.size()));
    return cells;
}

std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
    std::string text = "\"";
    for (const char character : cell)
        text += character == '"' ? std::string("\"\"") : std::string(1, character);
    return text + '"';
}

std::string line_of_cells(const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + quoted(cells[i]);
    return line + '\n';
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
}

CsvTable read_csv(std::string_view text) {
    CsvTable table;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // as spreadsheets write it
    if (!text.empty()) table.columns = take_cells(text);
    while (!text.empty()) {
        std::vector<std::string> cells = take_cells(text);
        cells.resize(table.columns.size());
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::string csv_text(const CsvTable& table) {
    std::string text = line_of_cells(table.columns);
    for (const std::vector<std::string>& row : table.rows) text += line_of_cells(row);
    return text;
}

tl::unexpected<Diagnostics> fail_at_row(const std::string& path, std::size_t row, std::string message,
                                        std::string help) {
    return fail(Place{path, static_cast<int>(row) + 2}, {}, std::move(message),
                std::move(help));  // below the header
}

}  // namespace gobo
