// The manifest.
#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "emit/emit.hpp"
#include "emit/sections.hpp"
#include "emit/stage_columns.hpp"
#include "family/constraint.hpp"
#include "family/key.hpp"
#include "reflect/interface_format.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kIndent = 2;
/// What a row of "stages" chooses of a column by.
constexpr std::string_view kDigits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";

/// As JSON; bytes that are no UTF-8 (a file's name may hold any) become U+FFFD.
std::string text_of(const Json& value, int indentation = -1) {
    return value.dump(indentation, ' ', false, Json::error_handler_t::replace);
}

/// Each value on a line of its own, one step further in than the array's.
std::string array_text(const std::vector<std::string>& rows, int indentation = kIndent) {
    if (rows.empty()) return "[]";
    const std::string line = fmt::format("\n{:{}}", "", indentation);
    return fmt::format("[{}  {}{}]", line, fmt::join(rows, "," + line + "  "), line);
}

std::vector<std::string> feature_rows(const Family& family) {
    std::vector<std::string> rows;
    for (const Feature& feature : family.features)
        rows.push_back(text_of(Json{{"name", feature.name},
                                    {"role", name_of(feature.role)},
                                    {"kind", name_of(feature.kind)},
                                    {"values", feature.values}}));
    return rows;
}

/// What the lists of pieces are told by: their names, and the stages of each kind as rows of columns, without
/// which the manifest of ten thousand keys would be all numbers.
struct StageTables {
    std::vector<std::string_view> names;   ///< of pieces, each once
    PerStage<std::vector<Numbers>> lists;  ///< of each stage of a kind: positions in `names`
    std::vector<int> positions;            ///< of the composition's stages, among those of their kind
};

StageTables tables_of(const Composition& composition) {
    StageTables tables;
    std::map<std::string_view, std::size_t> numbers;
    for (const Stage& stage : composition.stages) {
        std::vector<Numbers>& lists = tables.lists[stage.kind];
        tables.positions.push_back(static_cast<int>(lists.size()));
        Numbers& list = lists.emplace_back();
        for (const int piece : stage.pieces) {
            const std::string_view name = composition.piece(piece).name;
            const auto [number, is_new] = numbers.try_emplace(name, tables.names.size());
            if (is_new) tables.names.push_back(name);
            list.push_back(number->second);
        }
    }
    return tables;
}

/// The kinds of stages that there are, each with its columns and rows.
std::string stages_text(const StageTables& tables) {
    std::vector<std::string> kinds;
    for (const StageNames& stage : kStages) {
        const std::vector<Numbers>& lists = tables.lists[stage.kind];
        if (lists.empty()) continue;
        const StageColumns table = columns_of(lists, kDigits.size());
        std::vector<std::string> columns;
        for (const std::vector<Numbers>& column : table.columns) columns.push_back(text_of(column));
        std::vector<std::string> rows;
        for (const Numbers& row : table.rows) {
            std::string& digits = rows.emplace_back("\"");
            for (const std::size_t choice : row) digits += kDigits[choice];
            digits += '"';
        }
        kinds.push_back(fmt::format("\"{}\": {{\n      \"columns\": {},\n      \"rows\": {}\n    }}",
                                    stage.name, array_text(columns, 6), array_text(rows, 6)));
    }
    return fmt::format("{{\n    {}\n  }}", fmt::join(kinds, ",\n    "));
}

/// Which declarations a permutation has of the names that others declare differently, by their order.
std::string declared_text(const std::vector<Differing>& differing, std::size_t permutation) {
    if (differing.empty()) return "";
    std::vector<int> numbers;
    for (const Differing& one : differing) numbers.push_back(one.declared[permutation]);
    return fmt::format(",\"declared\":[{}]", fmt::join(numbers, ","));
}

std::vector<std::string> differing_rows(const std::vector<Differing>& differing) {
    std::vector<std::string> rows;
    for (const Differing& one : differing)
        rows.push_back(text_of(Json{{"kind", one.kind}, {"name", one.name}}));
    return rows;
}

/// What a budget chose the key by, as further members of its row; nothing where none did.
std::string choice_text(const std::vector<QualityChoice>& qualities, const Key& key) {
    for (const QualityChoice& choice : qualities)
        if (choice.key == key)
            return fmt::format(
                "{},\"typical_error\":{:.6g},\"measured_error\":{:.6g},\"cost\":{:.6g},\"chosen_by\":{}",
                choice.promised_error ? fmt::format(",\"promised_error\":{:.6g}", *choice.promised_error)
                                      : "",
                choice.typical_error, choice.measured_error, choice.cost, text_of(choice.source));
    return "";
}

/// The stages that a permutation has, as further members of its row.
std::string stage_members(const StageNumbers& stages, const std::vector<int>& positions) {
    std::string text;
    for (const StageNames& stage : kStages)
        if (stages[stage.kind] >= 0)
            text += fmt::format(",\"{}\":{}", stage.name,
                                positions[static_cast<std::size_t>(stages[stage.kind])]);
    return text;
}

std::vector<std::string> permutation_rows(const EmitInput& input, const std::vector<int>& positions) {
    std::vector<std::pair<std::string, const Permutation*>> sorted;
    for (const Permutation& permutation : input.composition.permutations)
        sorted.emplace_back(key_text(input.family, permutation.key), &permutation);
    std::ranges::sort(sorted);
    std::vector<std::string> rows;
    for (const auto& [key, permutation] : sorted)
        rows.push_back(fmt::format(
            "{{\"key\":{}{}{}{}}}", text_of(key), stage_members(permutation->stages, positions),
            choice_text(input.qualities, permutation->key),
            declared_text(input.differing,
                          static_cast<std::size_t>(permutation - input.composition.permutations.data()))));
    return rows;
}

std::vector<std::string> domain_rows(const std::vector<Domain>& domains) {
    std::vector<std::string> rows;
    for (const Domain& domain : domains) {
        if (is_constraint(domain.name)) {
            rows.push_back(text_of(Json{{"constraint", domain.name}}));
            continue;
        }
        Json row{{"name", domain.name}, {domain.of_length ? "length" : "range", {domain.low, domain.high}}};
        if (!domain.also.empty()) row["also"] = domain.also;
        if (!domain.last.empty()) row["last"] = domain.last;
        rows.push_back(text_of(row));
    }
    return rows;
}

/// A text of several lines, as a value within the manifest's outermost object.
std::string indented(const std::string& text) {
    std::string result;
    for (const char character : text) {
        result += character;
        if (character == '\n') result.append(kIndent, ' ');
    }
    return result;
}

}  // namespace

std::string emit_manifest(const EmitInput& input) {
    const Json interface = to_json(with_places(input.interface));
    const StageTables tables = tables_of(input.composition);
    std::vector<std::string> names;
    for (const std::string_view name : tables.names) names.push_back(text_of(name));
    return fmt::format(
        "{{\n  \"family\": {},\n  \"dialect\": {},\n  \"features\": {},\n  \"interface\": {},\n"
        "{}{}  \"pieces\": {},\n  \"digits\": \"{}\",\n  \"stages\": {},\n  \"permutations\": {}\n}}\n",
        text_of(input.family.name), text_of(version_of(input.composition)),
        array_text(feature_rows(input.family)), indented(text_of(interface, kIndent)),
        input.differing.empty()
            ? std::string()
            : fmt::format("  \"differing\": {},\n", array_text(differing_rows(input.differing))),
        input.narrowed.empty() ? std::string()
                               : fmt::format("  \"domain\": {},\n", array_text(domain_rows(input.narrowed))),
        array_text(names), kDigits, stages_text(tables),
        array_text(permutation_rows(input, tables.positions)));
}

}  // namespace gobo
