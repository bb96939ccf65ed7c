#include "lab/study/read_study.hpp"

#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "budget/qualities.hpp"
#include "family/key.hpp"

namespace gobo::study {
namespace {

double number_in(const std::string& cell) {
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return error == std::errc() && end == cell.data() + cell.size()
               ? number
               : std::numeric_limits<double>::quiet_NaN();
}

Diagnostic problem(const std::string& path, std::size_t row, std::string message) {
    Diagnostic diagnostic;
    diagnostic.place = {path, static_cast<int>(row) + 2, 0};
    diagnostic.message = std::move(message);
    diagnostic.help =
        "name effects that the study holds, or make a study of them: gobo study FAMILY "
        "--effects KEY -o FOLDER";
    return diagnostic;
}

/// The cells of a row by the names of their columns.
class Cells {
  public:
    Cells(const CsvTable& table, std::size_t row) : table_(table), row_(table.rows[row]) {}
    [[nodiscard]] std::string text(std::string_view column) const {
        const auto index = table_.column(column);
        return index ? row_[*index] : "";
    }
    [[nodiscard]] double number(std::string_view column) const { return number_in(text(column)); }

  private:
    const CsvTable& table_;
    const std::vector<std::string>& row_;
};

Spread spread_in(const Cells& cells, const std::string& column) {
    return {cells.number(column), cells.number(column + "_q1"), cells.number(column + "_q3")};
}

std::optional<Timing> timing_in(const Cells& cells) {
    if (cells.text("rounds").empty()) return std::nullopt;
    Timing timing;
    for (const auto& [slopes, clock] :
         {std::pair{&timing.elapsed, "elapsed"}, std::pair{&timing.processor, "processor"}}) {
        slopes->fragment = spread_in(cells, fmt::format("fragment_ns_{}", clock));
        slopes->vertex = spread_in(cells, fmt::format("vertex_ns_{}", clock));
    }
    timing.rounds = static_cast<int>(cells.number("rounds"));
    timing.renderer = cells.text("renderer");
    return timing;
}

StudyRow row_in(const Family& family, const Cells& cells, const Key& key) {
    StudyRow row;
    row.effects = cells.text("effects");
    row.key = cells.text("key");
    row.quality = quality_text(family, key);
    row.scene = cells.text("scene");
    row.error = {cells.number("error_max"), cells.number("error_p999"), cells.number("error_rms")};
    row.rounding.max = cells.number("rounding_max");
    row.approximation.max = cells.number("approximation_max");
    row.rate.max = cells.number("rate_max");
    row.costs.fragment = cells.number("fragment_cost");
    row.costs.vertex = cells.number("vertex_cost");
    row.costs.vertices_per_fragment = cells.number("vertices_per_fragment");
    row.costs.total = cells.number("cost");
    row.on_front = cells.text("front") == "yes";
    row.dominated_by = cells.text("dominated_by");
    row.timing = timing_in(cells);
    if (row.timing && !cells.text("time_front").empty())
        row.on_time_front = cells.text("time_front") == "yes";
    return row;
}

}  // namespace

Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path, const Family& family,
                                        const Key& effects) {
    const CsvTable table = read_csv(csv);
    for (const char* column : {"effects", "key", "scene", "error_max", "cost", "front"})
        if (!table.column(column)) return fail(problem(path, 0, fmt::format("has no column '{}'", column)));
    std::vector<StudyRow> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const Cells cells(table, i);
        if (cells.text("scene") != kAllScenes) continue;
        const auto own = parse_key(family, cells.text("effects"));
        const auto key = parse_key(family, cells.text("key"));
        if (!own || !key) return fail(problem(path, i, (own ? key.error() : own.error()).front().message));
        if (*own == effects) rows.push_back(row_in(family, cells, *key));
    }
    if (!rows.empty()) return rows;
    return fail(problem(path, 0, fmt::format("holds no '{}'", key_text(family, effects))));
}

}  // namespace gobo::study
