#include "lab/study/csv_text.hpp"

namespace gobo::study {
namespace {

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

std::string csv_text(const CsvTable& table) {
    std::string text = line_of_cells(table.columns);
    for (const std::vector<std::string>& row : table.rows) text += line_of_cells(row);
    return text;
}

}  // namespace gobo::study
