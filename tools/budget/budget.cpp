#include "budget/budget.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

double number_in(const std::string& cell) {
    return number_from<double>(cell).value_or(std::numeric_limits<double>::infinity());
}

bool is_within(const StudiedKey& key, const Budget& budget) {
    return (budget.max_error <= 0 || typical_error(key) <= budget.max_error) &&
           (budget.max_cost <= 0 || key.cost <= budget.max_cost);
}

/// The better buy of two within the budget comes first.
auto price(const StudiedKey& key, const Budget& budget) {
    const bool by_cost = budget.max_error > 0;
    return std::tuple(by_cost ? key.cost : key.error, by_cost ? key.error : key.cost, key.key);
}

std::string nearest_text(const std::vector<StudiedKey>& keys, const Budget& budget) {
    const auto least = [&](double StudiedKey::*what) { return std::ranges::min(keys, {}, what).*what; };
    return budget.max_error > 0
               ? fmt::format("the most accurate one may err by {}",
                             short_number(kSafety * least(&StudiedKey::error)))
               : fmt::format("the cheapest one costs {}", short_number(least(&StudiedKey::cost)));
}

/// The worst of several chips: how many times the cycles of the cheapest key a key takes. By one chip the
/// cycles.
void set_costs(std::vector<StudiedKey>& keys, const std::vector<std::vector<double>>& cycles) {
    for (std::size_t gpu = 0; !cycles.empty() && gpu < cycles.front().size(); ++gpu) {
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<double>& of_key : cycles) least = std::min(least, of_key[gpu]);
        const double unit = cycles.front().size() == 1 || !std::isfinite(least) ? 1 : least;
        for (std::size_t i = 0; i < keys.size(); ++i)
            keys[i].cost = gpu == 0 ? cycles[i][gpu] / unit : std::max(keys[i].cost, cycles[i][gpu] / unit);
    }
}

/// Which chips a study has, and how to add others.
std::string help_with_cycles(const CsvTable& table, const std::string& path, const Family& family,
                             const std::vector<std::string>& gpus) {
    constexpr std::string_view kPrefix = "cycles_";
    std::vector<std::string> known;
    for (const std::string& column : table.columns)
        if (column.starts_with(kPrefix)) known.push_back(column.substr(kPrefix.size()));
    const std::string shipped = fmt::format("data/study/{}.csv", family.name);
    const bool is_shipped = path == shipped;
    return fmt::format(
        "{}{}gobo cost {} --study {}{} --gpu {} > study.csv, and choose by --study study.csv",
        known.empty() ? "add them: " : fmt::format("it has those of {}; add others: ", join(known, ", ")),
        is_shipped ? "gobo library -o library, then " : "", family.name, is_shipped ? "library/" : "", path,
        join(gpus, ","));
}

}  // namespace

Key effects_of(const Family& family, Key key) {
    for (std::size_t i = 0; i < key.size(); ++i)
        if (family.features[i].role == Role::quality) key[i] = 0;
    return canonical(family, std::move(key), kStudiedDialect);
}

Result<StudiedEffects> read_studied(std::string_view csv, const std::string& path, const Family& family,
                                    const std::vector<std::string>& gpus) {
    const auto problem = [&](std::size_t row, std::string message) {
        return fail_at_row(path, row, std::move(message),
                           fmt::format("remake the study: gobo study {} -o FOLDER", family.name));
    };
    const CsvTable table = read_csv(csv);
    std::array<std::size_t, 6> columns;  // where they stand
    constexpr std::array names = {"effects", "key", "scene", "error_max", "cost", "front"};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto column = table.column(names[i]);
        if (!column) return problem(0, "is not a study.csv");
        columns[i] = *column;
    }
    const auto [effects_at, key_at, scene_at, error_at, cost_at, front_at] = columns;
    std::vector<std::size_t> cycles_at;
    for (const std::string& gpu : gpus) {
        const auto column = table.column("cycles_" + gpu);
        if (!column)
            return fail({path, 1, 0}, "", fmt::format("holds no cycles of {}", gpu),
                        help_with_cycles(table, path, family, gpus));
        cycles_at.push_back(*column);
    }
    StudiedEffects studied;
    std::map<Key, std::vector<std::vector<double>>> cycles;  // by effects, key and chip
    const auto worst_at = table.column("error_worst");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const std::vector<std::string>& row = table.rows[i];
        if (row[scene_at] != kAllScenes) continue;
        const auto effects = parse_key(family, row[effects_at]);
        const auto key = parse_key(family, row[key_at]);
        if (!effects || !key) return problem(i, (effects ? key : effects).error().front().message);
        studied[*effects].push_back(
            {*key, number_in(row[error_at]), number_in(row[cost_at]), row[front_at] == "yes",
             worst_at && !row[*worst_at].empty() ? std::optional(number_in(row[*worst_at])) : std::nullopt});
        std::vector<double>& of_key = cycles[*effects].emplace_back();
        for (const std::size_t at : cycles_at) of_key.push_back(number_in(row[at]));
    }
    for (auto& [effects, keys] : studied) set_costs(keys, cycles[effects]);
    return studied;
}

double typical_error(const StudiedKey& key) {
    return kSafety * key.error;
}

std::optional<double> promised_error(const StudiedKey& key) {
    if (!key.worst || !(kDomainSafety * *key.worst < 1)) return std::nullopt;
    return std::max(typical_error(key), kDomainSafety * *key.worst);
}

std::vector<StudiedKey> within(const std::vector<StudiedKey>& keys, const Budget& budget) {
    std::vector<StudiedKey> allowed;
    for (const StudiedKey& key : keys)
        if (is_within(key, budget)) allowed.push_back(key);
    std::ranges::sort(allowed, {}, [&](const StudiedKey& key) { return price(key, budget); });
    return allowed;
}

Result<StudiedKey> choose(const std::vector<StudiedKey>& keys, const Budget& budget,
                          const std::string& subject) {
    const std::vector<StudiedKey> best = within(keys, budget);
    if (!best.empty()) return best.front();
    std::vector<std::string> limits;
    if (budget.max_error > 0) limits.push_back(fmt::format("an error of {}", budget.max_error));
    if (budget.max_cost > 0) limits.push_back(fmt::format("a cost of {}", budget.max_cost));
    return fail({.message = "no quality is within " + join(limits, " and "),
                 .help = keys.empty() ? "" : "raise the budget: " + nearest_text(keys, budget),
                 .subject = subject});
}

}  // namespace gobo
