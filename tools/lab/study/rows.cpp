#include "lab/study/rows.hpp"

#include <algorithm>
#include <concepts>
#include <limits>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/study/qualities.hpp"

namespace gobo::study {
namespace {

std::string counts_text(const evaluate::Counts& counts) {
    std::string text;
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        if (counts[kind] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : " ", evaluate::kKindNames[kind], counts[kind]);
    return text;
}

using Part = double Spread::*;
constexpr std::array<std::pair<const char*, Part>, 3> kParts = {
    {{"", &Spread::median}, {"_q1", &Spread::low}, {"_q3", &Spread::high}}};

/// What a cell of a column says: a number, a text, or one of two words. Nothing is an empty cell.
struct Words {
    const char* yes = "yes";
    const char* no = "no";
};

std::string cell_of(const std::string& text) {
    return text;
}
/// Six significant digits: more than any measurement here has.
std::string cell_of(double number) {
    return fmt::format("{:.6g}", number);
}
std::string cell_of(std::integral auto number) {
    return std::to_string(number);
}
std::string cell_of(bool value, const Words& words) {
    return value ? words.yes : words.no;
}
std::string cell_of(const auto& value, const auto&... words) requires requires {
    value.has_value();
}
{ return value ? cell_of(*value, words...) : ""; }

void read_cell(const std::string& cell, std::string& text) {
    text = cell;
}
void read_cell(const std::string& cell, double& number) {
    number = number_from<double>(cell).value_or(std::numeric_limits<double>::quiet_NaN());
}
void read_cell(const std::string& cell, std::integral auto& number) {
    number = static_cast<std::remove_reference_t<decltype(number)>>(number_from<double>(cell).value_or(0));
}
void read_cell(const std::string& cell, bool& value, const Words& words) {
    value = cell == words.yes;
}
void read_cell(const std::string& cell, auto& value, const auto&... words) requires requires {
    value.has_value();
}
{
    if (!cell.empty()) read_cell(cell, value.emplace(), words...);
}

/// The columns of study.csv: calls `column` with the name of each and a row's member, and `derived` with the
/// names and cells of those that nobody reads.
template <class Row>
void visit_columns(Row& row, const auto& column, const auto& derived) {
    column("effects", row.effects);
    column("key", row.key);
    column("scene", row.scene);
    column("reference", row.from_oracle, Words{"oracle", "fp64"});
    column("pixels", row.pixels);
    column("edges", row.edges);
    column("error_max", row.total.max);
    column("error_p999", row.total.p999);
    column("error_rms", row.total.rms);
    column("error_relative", row.relative);
    column("rounding_max", row.rounding.max);
    column("rounding_rms", row.rounding.rms);
    column("approximation_max", row.approximation.max);
    column("approximation_rms", row.approximation.rms);
    column("rate_max", row.rate.max);
    column("rate_rms", row.rate.rms);
    column("fragment_cost", row.costs.fragment);
    column("vertex_cost", row.costs.vertex);
    column("vertices_per_fragment", row.costs.vertices_per_fragment);
    column("cost", row.costs.total);
    column("front", row.on_front, Words{});
    column("dominated_by", row.dominated_by);
    Timing timing = row.timing.value_or(Timing{});
    const auto spread = [&](const std::string& name, Spread& own) {
        for (const auto& [suffix, part] : kParts) {
            std::optional<double> number;
            if (row.timing) number = own.*part;
            column(name + suffix, number);
            own.*part = number.value_or(0);
        }
    };
    spread("fragment_ns_elapsed", timing.elapsed.fragment);
    spread("vertex_ns_elapsed", timing.elapsed.vertex);
    spread("fragment_ns_processor", timing.processor.fragment);
    spread("vertex_ns_processor", timing.processor.vertex);
    for (const auto& [suffix, part] : kParts)
        derived(std::string("time_ns") + suffix, row.timing ? cell_of(row.time().*part) : "");
    column("time_front", row.on_time_front, Words{});
    std::optional<int> rounds;
    if (row.timing) rounds = timing.rounds;
    column("rounds", rounds);
    column("renderer", timing.renderer);
    timing.rounds = rounds.value_or(0);
    if constexpr (!std::is_const_v<Row>)
        if (rounds) row.timing = timing;
    column("fragment_instructions", row.instructions);
    if constexpr (!std::is_const_v<Row>) column("error_worst", row.worst);
    derived("fragment_operations", counts_text(row.work.fragments));
    derived("vertex_operations", counts_text(row.work.vertices));
}

void widen(ErrorFigures& worst, const ErrorFigures& other) {
    worst.max = std::max(worst.max, other.max);
    worst.p999 = std::max(worst.p999, other.p999);
    worst.rms = std::max(worst.rms, other.rms);
}

/// The worst error, the mean cost.
StudyRow row_of_all(const std::vector<StudyRow>& scenes) {
    StudyRow all;
    const auto count = static_cast<double>(scenes.size());
    all.from_oracle = true;
    for (const StudyRow& row : scenes) {
        all.from_oracle = all.from_oracle && row.from_oracle;
        all.pixels += row.pixels;
        all.edges += row.edges;
        for (const auto figures :
             {&StudyRow::total, &StudyRow::rounding, &StudyRow::approximation, &StudyRow::rate})
            widen(all.*figures, row.*figures);
        all.relative = std::max(all.relative, row.relative);
        for (const auto cost :
             {&Costs::fragment, &Costs::vertex, &Costs::vertices_per_fragment, &Costs::total})
            all.costs.*cost += row.costs.*cost / count;
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) {
            all.work.vertices[kind] += row.work.vertices[kind];
            all.work.fragments[kind] += row.work.fragments[kind];
        }
    }
    return all;
}

/// `rows` are one scene's, one for each key.
void mark_front(const std::vector<StudyRow*>& rows) {
    std::vector<Priced> points;
    for (const StudyRow* row : rows) points.push_back({row->costs.total, row->total.max});
    const auto by = dominators(points);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i]->on_front = !by[i];
        if (by[i]) rows[i]->dominated_by = rows[*by[i]]->key;
    }
}

/// `rows` are those over all scenes, one for each key: the timed ones are compared.
void mark_time_front(std::vector<StudyRow*> rows, const std::optional<Control>& control) {
    std::erase_if(rows, [](const StudyRow* row) { return !row->timing; });
    if (rows.empty() || !control || control->ranked(rows.front()->timing->renderer) > kLargestControl) return;
    for (StudyRow* row : rows)
        row->on_time_front = std::none_of(rows.begin(), rows.end(), [&](const StudyRow* other) {
            return other->total.max <= row->total.max && other->time().high < row->time().low;
        });
}

bool is_less(const ErrorFigures& first, const ErrorFigures& second, const ErrorFigures& accurate) {
    return first.max + kChance * accurate.max < second.max || first.rms + kChance * accurate.rms < second.rms;
}

/// How two values of a feature compare over all pairs of keys that differ in nothing else.
struct Duel {
    std::size_t pairs = 0;
    bool is_never_worse = true;  ///< the first: neither dearer nor less accurate
    bool is_ever_better = false;

    void add(const Measurement& first, const Measurement& second, const Measurement& accurate,
             const Weights& weights) {
        const double first_cost = costs_of(first, weights).total;
        const double second_cost = costs_of(second, weights).total;
        ++pairs;
        if (first_cost > second_cost || is_less(second.total, first.total, accurate.total))
            is_never_worse = false;
        if (first_cost < second_cost || is_less(first.total, second.total, accurate.total))
            is_ever_better = true;
    }
};

/// All duels between values of one feature, by their numbers.
using Duels = std::map<std::pair<int, int>, Duel>;

Duels duels_of(const Study& study, const Weights& weights, std::size_t feature) {
    Duels duels;
    for (const EffectsResult& effects : study.effects) {
        std::map<Key, std::vector<const KeyResult*>> alike;
        for (const KeyResult& result : effects.keys) {
            Key others = result.key;
            others[feature] = 0;
            alike[others].push_back(&result);
        }
        for (const auto& [others, results] : alike)
            for (const KeyResult* first : results)
                for (const KeyResult* second : results)
                    for (std::size_t scene = 0; first != second && scene < first->scenes.size(); ++scene)
                        duels[{first->key[feature], second->key[feature]}].add(
                            first->scenes[scene], second->scenes[scene], effects.keys.front().scenes[scene],
                            weights);
    }
    return duels;
}

void add_alone(ChoiceSummary& summary, const KeyResult& choice, const KeyResult& accurate,
               const Weights& weights) {
    double cost = 0;
    double accurate_cost = 0;
    for (std::size_t scene = 0; scene < choice.scenes.size(); ++scene) {
        summary.error_max = std::max(summary.error_max, choice.scenes[scene].total.max);
        summary.error_rms = std::max(summary.error_rms, choice.scenes[scene].total.rms);
        cost += costs_of(choice.scenes[scene], weights).total;
        accurate_cost += costs_of(accurate.scenes[scene], weights).total;
    }
    summary.least_cost = std::min(summary.least_cost, cost / accurate_cost);
    summary.most_cost = std::max(summary.most_cost, cost / accurate_cost);
    ++summary.combinations;
}

/// The value alone, in all effects that it matters to; the most accurate value where another one matters.
void measure_alone(const Family& family, const Study& study, const Weights& weights, int feature, int value,
                   ChoiceSummary& summary) {
    summary.least_cost = std::numeric_limits<double>::infinity();
    const int best = most_accurate_value(family.features[static_cast<std::size_t>(feature)]);
    for (const EffectsResult& effects : study.effects) {
        const KeyResult& accurate = effects.keys.front();
        const std::vector<Choice> choices = single_choices(family, effects.effects);
        bool matters = false;
        for (const Choice& choice : choices) {
            if (choice.feature != feature) continue;
            matters = true;
            if (choice.value != value) continue;
            for (const KeyResult& result : effects.keys)
                if (result.key == choice.key) add_alone(summary, result, accurate, weights);
        }
        if (value == best && matters) add_alone(summary, accurate, accurate, weights);
    }
    if (summary.combinations == 0) summary.least_cost = 0;
}

constexpr const char* kStudyHelp =
    "name effects that the study holds, or make a study of them: gobo study FAMILY --effects KEY -o FOLDER";

/// Where a chip's figures stand.
struct ChipColumns {
    std::string gpu;
    std::size_t cycles = 0;
    std::optional<std::size_t> front, driver, instructions;
};

std::vector<ChipColumns> chip_columns(const CsvTable& table) {
    constexpr std::string_view kPrefix = "cycles_";
    std::vector<ChipColumns> chips;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (!table.columns[i].starts_with(kPrefix)) continue;
        const std::string gpu = table.columns[i].substr(kPrefix.size());
        chips.push_back({gpu, i, table.column("front_" + gpu), table.column("driver_" + gpu),
                         table.column("instructions_" + gpu)});
    }
    return chips;
}

ChipRow chip_row(const ChipColumns& columns, const std::vector<std::string>& cells) {
    const auto cell = [&](const std::optional<std::size_t>& at) { return at ? cells[*at] : ""; };
    ChipRow chip{columns.gpu,
                 cell(columns.driver),
                 number_from<double>(cells[columns.cycles]),
                 cell(columns.front) == "yes",
                 {}};
    const std::vector<std::string> words = split(cell(columns.instructions), ' ');
    for (std::size_t i = 0; i + 1 < words.size(); i += 2)
        chip.instructions[words[i]] = number_from<double>(words[i + 1]).value_or(0);
    return chip;
}

}  // namespace

Spread StudyRow::time() const {
    const Slopes& slopes = timing->ranked();
    Spread time;
    for (const auto& [suffix, part] : kParts)
        time.*part = slopes.fragment.*part + costs.vertices_per_fragment * slopes.vertex.*part;
    return time;
}

std::vector<StudyRow> rows_of(const Family& family, const Study& study, const Weights& weights) {
    std::vector<StudyRow> rows;
    const std::size_t stride = study.scenes.size() + 1;
    for (const EffectsResult& effects : study.effects) {
        const std::size_t first = rows.size();
        for (const KeyResult& result : effects.keys) {
            std::vector<StudyRow> own;
            for (const Measurement& measured : result.scenes) {
                StudyRow& row = own.emplace_back();
                static_cast<Measurement&>(row) = measured;
                row.costs = costs_of(measured, weights);
            }
            own.insert(own.begin(), row_of_all(own));
            own.front().timing = result.timing;
            own.front().instructions = result.instructions;
            for (std::size_t i = 0; i < own.size(); ++i) {
                own[i].effects = key_text(family, effects.effects);
                own[i].key = key_text(family, result.key);
                own[i].quality = quality_text(family, result.key);
                own[i].scene = i == 0 ? kAllScenes : study.scenes[i - 1];
                rows.push_back(std::move(own[i]));
            }
        }
        for (std::size_t scene = 0; scene < stride; ++scene) {
            std::vector<StudyRow*> of_scene;
            for (std::size_t i = first + scene; i < rows.size(); i += stride) of_scene.push_back(&rows[i]);
            mark_front(of_scene);
            if (scene == 0) mark_time_front(std::move(of_scene), effects.control);
        }
    }
    return rows;
}

std::string study_csv(const std::vector<StudyRow>& rows) {
    CsvTable table;
    const StudyRow none;
    const auto name = [&](const std::string& column, const auto&...) { table.columns.push_back(column); };
    visit_columns(none, name, name);
    for (const StudyRow& row : rows) {
        std::vector<std::string>& cells = table.rows.emplace_back();
        visit_columns(
            row,
            [&](const std::string&, const auto& member, const auto&... words) {
                cells.push_back(cell_of(member, words...));
            },
            [&](const std::string&, const std::string& cell) { cells.push_back(cell); });
    }
    return csv_text(table);
}

Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path, const Family& family) {
    const CsvTable table = read_csv(csv);
    for (const char* column : {"effects", "key", "scene", "error_max", "cost", "front"})
        if (!table.column(column))
            return fail_at_row(path, 0, fmt::format("has no column '{}'", column), kStudyHelp);
    const std::vector<ChipColumns> chips = chip_columns(table);
    std::vector<StudyRow> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        StudyRow& row = rows.emplace_back();
        visit_columns(
            row,
            [&](const std::string& name, auto& member, const auto&... words) {
                if (const auto index = table.column(name)) read_cell(table.rows[i][*index], member, words...);
            },
            [](const auto&...) {});
        const auto effects = parse_key(family, row.effects);
        const auto key = parse_key(family, row.key);
        if (!effects || !key)
            return fail_at_row(path, i, (effects ? key : effects).error().front().message, kStudyHelp);
        row.quality = quality_text(family, *key);
        for (const ChipColumns& columns : chips) row.chips.push_back(chip_row(columns, table.rows[i]));
    }
    return rows;
}

Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path, const Family& family,
                                        const Key& effects) {
    GOBO_TRY(std::vector<StudyRow> rows, read_rows(csv, path, family));
    std::erase_if(rows, [&](const StudyRow& row) {
        return row.scene != kAllScenes || parse_key(family, row.effects).value() != effects;
    });
    if (!rows.empty()) return rows;
    return fail_at_row(path, 0, fmt::format("holds no '{}'", key_text(family, effects)), kStudyHelp);
}

std::vector<StudyRow> summary_of(const Family& family, const std::vector<StudyRow>& rows) {
    std::vector<StudyRow> summary;
    for (const StudyRow& row : rows) {
        if (row.scene != kAllScenes) continue;
        const std::vector<Choice> singles = single_choices(family, parse_key(family, row.effects).value());
        const bool is_single =
            row.quality.empty() || std::any_of(singles.begin(), singles.end(), [&](const Choice& choice) {
                return key_text(family, choice.key) == row.key;
            });
        if (row.on_front || is_single) summary.push_back(row);
    }
    return summary;
}

std::string curves_csv(const std::vector<CurvePoint>& curves) {
    CsvTable table;
    table.columns = {"feature",   "value",     "over",      "number",   "effects",
                     "model_max", "model_rms", "error_max", "error_rms"};
    for (const CurvePoint& point : curves)
        table.rows.push_back({point.feature, point.value, point.over, cell_of(point.number), point.effects,
                              cell_of(point.error.max), cell_of(point.error.rms), cell_of(point.total.max),
                              cell_of(point.total.rms)});
    return csv_text(table);
}

std::vector<ChoiceSummary> summarise_choices(const Family& family, const Study& study,
                                             const Weights& weights) {
    std::vector<ChoiceSummary> summaries;
    for (const int index : quality_features(family)) {
        const Feature& feature = family.features[static_cast<std::size_t>(index)];
        const Duels duels = duels_of(study, weights, static_cast<std::size_t>(index));
        const int values = static_cast<int>(feature.values.size());
        for (int value = 0; value < values; ++value) {
            ChoiceSummary& summary = summaries.emplace_back();
            summary.feature = feature.name;
            summary.value = feature.values[static_cast<std::size_t>(value)];
            summary.is_most_accurate = value == most_accurate_value(feature);
            summary.is_excluded = std::find(feature.excluded.begin(), feature.excluded.end(),
                                            summary.value) != feature.excluded.end();
            measure_alone(family, study, weights, index, value, summary);
            // Nothing is more accurate than the most accurate value, and it may be there for inputs that no
            // scene has.
            if (summary.is_most_accurate) continue;
            for (int other = 0; other < values && summary.dominated_by.empty(); ++other) {
                const auto duel = duels.find({other, value});
                if (duel == duels.end() || !duel->second.is_never_worse || !duel->second.is_ever_better)
                    continue;
                summary.dominated_by = feature.values[static_cast<std::size_t>(other)];
                summary.pairs = duel->second.pairs;
            }
        }
    }
    return summaries;
}

}  // namespace gobo::study
