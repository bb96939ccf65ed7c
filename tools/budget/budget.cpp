#include "budget/budget.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

double number_in(const std::string& cell) {
    return number_in_cell(cell).value_or(std::numeric_limits<double>::infinity());
}

/// Where the columns that budgets need stand.
struct Columns {
    std::size_t effects = 0, key = 0, scene = 0, error = 0, cost = 0, front = 0;
};

std::optional<Columns> columns_of(const CsvTable& table) {
    Columns columns;
    for (const auto& [name, to] : {std::pair{"effects", &columns.effects}, std::pair{"key", &columns.key},
                                   std::pair{"scene", &columns.scene}, std::pair{"error_max", &columns.error},
                                   std::pair{"cost", &columns.cost}, std::pair{"front", &columns.front}}) {
        const auto column = table.column(name);
        if (!column) return std::nullopt;
        *to = *column;
    }
    return columns;
}

bool is_within(const StudiedKey& key, const Budget& budget) {
    return (!budget.max_error || kSafety * key.error <= *budget.max_error) &&
           (!budget.max_cost || key.cost <= *budget.max_cost);
}

/// Whether `a` is the better buy of two within the budget.
bool is_better(const StudiedKey& a, const StudiedKey& b, const Budget& budget) {
    if (budget.max_error) return std::tie(a.cost, a.error, a.key) < std::tie(b.cost, b.error, b.key);
    return std::tie(a.error, a.cost, a.key) < std::tie(b.error, b.cost, b.key);
}

std::string nearest_text(const std::vector<StudiedKey>& keys, const Budget& budget) {
    const auto by_error = [](const StudiedKey& a, const StudiedKey& b) { return a.error < b.error; };
    const auto by_cost = [](const StudiedKey& a, const StudiedKey& b) { return a.cost < b.cost; };
    if (budget.max_error)
        return fmt::format(
            "the most accurate one promises {}",
            short_number(kSafety * std::min_element(keys.begin(), keys.end(), by_error)->error));
    return fmt::format("the cheapest one costs {}",
                       short_number(std::min_element(keys.begin(), keys.end(), by_cost)->cost));
}

}  // namespace

Result<StudiedEffects> read_studied(std::string_view csv, const std::string& path, const Family& family) {
    const auto problem = [&](std::size_t row, std::string message) {
        return fail_at_row(path, row, std::move(message),
                           fmt::format("remake the study: gobo study {} -o FOLDER", family.name));
    };
    const CsvTable table = read_csv(csv);
    const auto columns = columns_of(table);
    if (!columns) return problem(0, "is no study.csv");
    StudiedEffects studied;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const std::vector<std::string>& row = table.rows[i];
        if (row[columns->scene] != kAllScenes) continue;
        const auto effects = parse_key(family, row[columns->effects]);
        const auto key = parse_key(family, row[columns->key]);
        if (!effects || !key) {
            const Diagnostics& why = effects ? key.error() : effects.error();
            return problem(i, why.front().message);
        }
        studied[*effects].push_back({*key, number_in(row[columns->error]), number_in(row[columns->cost]),
                                     row[columns->front] == "yes"});
    }
    return studied;
}

Result<StudiedKey> choose(const std::vector<StudiedKey>& keys, const Budget& budget,
                          const std::string& subject) {
    const StudiedKey* best = nullptr;
    for (const StudiedKey& key : keys)
        if (is_within(key, budget) && (best == nullptr || is_better(key, *best, budget))) best = &key;
    if (best != nullptr) return *best;
    Diagnostic diagnostic;
    diagnostic.subject = subject;
    diagnostic.message = fmt::format("no quality is within {}{}{}",
                                     budget.max_error ? fmt::format("an error of {}", *budget.max_error) : "",
                                     budget.max_error && budget.max_cost ? " and " : "",
                                     budget.max_cost ? fmt::format("a cost of {}", *budget.max_cost) : "");
    if (!keys.empty()) diagnostic.help = "raise the budget: " + nearest_text(keys, budget);
    return fail(std::move(diagnostic));
}

}  // namespace gobo
