#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/sections.hpp"

namespace gobo {
namespace {

using PackedKey = std::vector<std::uint64_t>;
using Numbers = std::vector<std::size_t>;

PackedKey pack(const Key& values, const CppKey& key) {
    PackedKey words(static_cast<std::size_t>(key.words));
    for (std::size_t i = 0; i < key.features.size(); ++i) {
        const CppFeature& feature = key.features[i];
        if (feature.bits > 0)
            words[static_cast<std::size_t>(feature.word)] |= static_cast<std::uint64_t>(values[i])
                                                             << feature.shift;
    }
    return words;
}

std::string packed_text(const PackedKey& words) {
    std::vector<std::string> literals;
    for (const std::uint64_t word : words) {
        // A decimal literal without suffix is signed: one with the top bit set would have no type.
        const bool is_signed = word <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
        literals.push_back(fmt::format("{}{}", word, is_signed ? "" : "U"));
    }
    if (literals.size() == 1) return literals.front();
    return fmt::format("{{{{{}}}}}", fmt::join(literals, ", "));
}

std::string numbers_text(const Numbers& numbers) {
    if (numbers.empty()) return {};
    std::string text = "{";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += i % 20 == 0 ? "\n        " : " ";
        fmt::format_to(std::back_inserter(text), "{},", numbers[i]);
    }
    return text + "\n    }";
}

/// Adds the texts of a piece, which fits no single literal where it is long.
void add_texts(const Piece& piece, std::vector<std::string>& rows) {
    int line = 1;
    for (const std::string_view text : cut_for_literals(piece.text)) {
        rows.push_back(fmt::format("{{{}, {{{}, {}}}, {}}}", cpp_literal(piece.name), cpp_literal(text),
                                   text.size(), line));
        line += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    }
}

}  // namespace

void permutation_section(const Composition& composition, const CppKey& key, TemplateValues& values) {
    std::vector<bool> is_used(composition.stages.size());
    std::vector<std::pair<PackedKey, const Permutation*>> sorted;
    for (const Permutation& permutation : composition.permutations) {
        for (const int stage : {permutation.vertex, permutation.fragment})
            is_used[static_cast<std::size_t>(stage)] = true;
        sorted.emplace_back(pack(permutation.key, key), &permutation);
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& left, const auto& right) { return left.first < right.first; });

    std::vector<bool> is_named(composition.pieces.size());
    for (std::size_t i = 0; i < composition.stages.size(); ++i)
        for (const int piece : composition.stages[i].pieces)
            if (is_used[i]) is_named[static_cast<std::size_t>(piece)] = true;
    std::vector<std::string> texts;
    Numbers first_text;  // of each piece, and at the end their number
    for (std::size_t i = 0; i < composition.pieces.size(); ++i) {
        first_text.push_back(texts.size());
        if (is_named[i]) add_texts(composition.pieces[i], texts);
    }
    first_text.push_back(texts.size());

    Numbers stage_begins;
    Numbers piece_lists;
    Numbers stage_numbers;
    for (std::size_t i = 0; i < composition.stages.size(); ++i) {
        stage_numbers.push_back(stage_begins.size());
        if (!is_used[i]) continue;
        stage_begins.push_back(piece_lists.size());
        for (const int piece : composition.stages[i].pieces) {
            const auto at = static_cast<std::size_t>(piece);
            for (std::size_t text = first_text[at]; text < first_text[at + 1]; ++text)
                piece_lists.push_back(text);
        }
    }
    stage_begins.push_back(piece_lists.size());

    std::vector<std::string> keys;
    std::vector<std::string> rows;
    for (const auto& [packed, permutation] : sorted) {
        keys.push_back(packed_text(packed));
        rows.push_back(fmt::format("{{{}, {{{}}}, {{{}}}}}", keys.back(),
                                   stage_numbers[static_cast<std::size_t>(permutation->vertex)],
                                   stage_numbers[static_cast<std::size_t>(permutation->fragment)]));
    }
    const bool is_wide = texts.size() > std::numeric_limits<std::uint16_t>::max();
    values["index_type"] = is_wide ? "std::uint32_t" : "std::uint16_t";
    values["stage_begin_count"] = std::to_string(stage_begins.size());
    values["stage_begins"] = numbers_text(stage_begins);
    values["index_count"] = std::to_string(piece_lists.size());
    values["piece_lists"] = numbers_text(piece_lists);
    values["keys"] = cpp_list(keys);
    add_table(values, "piece", texts);
    add_table(values, "permutation", rows);
}

}  // namespace gobo
