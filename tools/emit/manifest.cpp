// The manifest.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "emit/emit.hpp"
#include "emit/sections.hpp"
#include "family/key.hpp"
#include "reflect/interface_format.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kIndent = 2;

/// As JSON; bytes that are no UTF-8 (a file's name may hold any) become U+FFFD.
std::string text_of(const Json& value, int indentation = -1) {
    return value.dump(indentation, ' ', false, Json::error_handler_t::replace);
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

std::vector<std::string> piece_rows(const Composition& composition) {
    std::vector<std::string> rows;
    for (const Piece& piece : composition.pieces) rows.push_back(text_of(piece.name));
    return rows;
}

std::vector<std::string> stage_rows(const Composition& composition) {
    std::vector<std::string> rows;
    for (const Stage& stage : composition.stages)
        rows.push_back(fmt::format("{{\"stage\":\"{}\",\"pieces\":[{}]}}", name_of(stage.kind),
                                   fmt::join(stage.pieces, ",")));
    return rows;
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
                ",\"promised_error\":{:.6g},\"measured_error\":{:.6g}{},\"cost\":{:.6g},\"chosen_by\":{}",
                choice.promised_error, choice.measured_error,
                choice.worst_error ? fmt::format(",\"worst_error\":{:.6g}", *choice.worst_error) : "",
                choice.cost, text_of(choice.source));
    return "";
}

/// The numbers of the stages that a permutation has, as further members of its row.
std::string stages_text(const StageNumbers& stages) {
    std::string text;
    for (const StageNames& stage : kStages)
        if (stages[stage.kind] >= 0) text += fmt::format(",\"{}\":{}", stage.name, stages[stage.kind]);
    return text;
}

std::vector<std::string> permutation_rows(const EmitInput& input) {
    std::vector<std::pair<std::string, const Permutation*>> sorted;
    for (const Permutation& permutation : input.composition.permutations)
        sorted.emplace_back(key_text(input.family, permutation.key), &permutation);
    std::ranges::sort(sorted);
    std::vector<std::string> rows;
    for (const auto& [key, permutation] : sorted)
        rows.push_back(fmt::format(
            "{{\"key\":{}{}{}{}}}", text_of(key), stages_text(permutation->stages),
            choice_text(input.qualities, permutation->key),
            declared_text(input.differing,
                          static_cast<std::size_t>(permutation - input.composition.permutations.data()))));
    return rows;
}

std::string array_text(const std::vector<std::string>& rows) {
    return rows.empty() ? "[]" : fmt::format("[\n    {}\n  ]", fmt::join(rows, ",\n    "));
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
    return fmt::format(
        "{{\n  \"family\": {},\n  \"dialect\": {},\n  \"features\": {},\n  \"interface\": {},\n"
        "{}  \"pieces\": {},\n  \"stages\": {},\n  \"permutations\": {}\n}}\n",
        text_of(input.family.name), text_of(version_of(input.composition)),
        array_text(feature_rows(input.family)), indented(text_of(interface, kIndent)),
        input.differing.empty()
            ? std::string()
            : fmt::format("  \"differing\": {},\n", array_text(differing_rows(input.differing))),
        array_text(piece_rows(input.composition)), array_text(stage_rows(input.composition)),
        array_text(permutation_rows(input)));
}

}  // namespace gobo
