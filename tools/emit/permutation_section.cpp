#include "emit/permutation_section.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/cpp_text.hpp"

namespace gobo {
namespace {

using PackedKey = std::vector<std::uint64_t>;
using Numbers = std::vector<std::size_t>;

PackedKey pack(const Key& values, const CppKey& key) {
    PackedKey words(static_cast<std::size_t>(key.words));
    for (std::size_t index = 0; index < key.features.size(); ++index) {
        const CppFeature& feature = key.features[index];
        if (feature.bits == 0) continue;
        words[static_cast<std::size_t>(feature.word)] |= static_cast<std::uint64_t>(values[index])
                                                         << feature.shift;
    }
    return words;
}

/// A decimal literal without suffix is signed: one with the top bit set would have no type.
std::string literal_of(std::uint64_t word) {
    const bool is_signed = word <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    return fmt::format("{}{}", word, is_signed ? "" : "U");
}

std::string packed_text(const PackedKey& words) {
    std::vector<std::string> literals(words.size());
    std::transform(words.begin(), words.end(), literals.begin(), literal_of);
    if (literals.size() == 1) return literals.front();
    return fmt::format("{{{{{}}}}}", fmt::join(literals, ", "));
}

/// Marks what is used, then numbers it in order.
struct Renumbering {
    std::vector<bool> used;
    Numbers number;

    explicit Renumbering(std::size_t count) : used(count), number(count) {}
    void use(int index) { used[static_cast<std::size_t>(index)] = true; }
};

std::string numbers_text(const Numbers& numbers) {
    std::string text = "{";
    for (std::size_t index = 0; index < numbers.size(); ++index) {
        text += index % 20 == 0 ? "\n        " : " ";
        fmt::format_to(std::back_inserter(text), "{},", numbers[index]);
    }
    return text + "\n    }";
}

/// The texts of the pieces in use. Each piece's number becomes that of its first text; `parts` counts its
/// texts.
std::vector<std::string> piece_rows(const Composition& composition, Renumbering& pieces, Numbers& parts) {
    std::vector<std::string> rows;
    for (std::size_t index = 0; index < composition.pieces.size(); ++index) {
        if (!pieces.used[index]) continue;
        const Piece& piece = composition.pieces[index];
        pieces.number[index] = rows.size();
        int line = 1;
        for (const std::string_view text : cut_for_literals(piece.text)) {
            rows.push_back(fmt::format("{{{}, {{{}, {}}}, {}}}", cpp_literal(piece.name), cpp_literal(text),
                                       text.size(), line));
            line += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
            ++parts[index];
        }
    }
    return rows;
}

/// The lists of all stages one after the other, and where each begins.
struct StageLists {
    Numbers begins;
    Numbers pieces;
};

StageLists stage_lists(const Composition& composition, Renumbering& stages, const Renumbering& pieces,
                       const Numbers& parts) {
    StageLists lists;
    for (std::size_t index = 0; index < composition.stages.size(); ++index) {
        if (!stages.used[index]) continue;
        stages.number[index] = lists.begins.size();
        lists.begins.push_back(lists.pieces.size());
        for (const int piece : composition.stages[index].pieces) {
            const auto number = static_cast<std::size_t>(piece);
            for (std::size_t part = 0; part < parts[number]; ++part) {
                lists.pieces.push_back(pieces.number[number] + part);
            }
        }
    }
    lists.begins.push_back(lists.pieces.size());
    return lists;
}

void add_permutations(const Composition& composition, const CppKey& key, const Renumbering& stages,
                      TemplateValues& values) {
    std::vector<std::pair<PackedKey, const Permutation*>> sorted;
    for (const Permutation& permutation : composition.permutations) {
        sorted.emplace_back(pack(permutation.key, key), &permutation);
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& left, const auto& right) { return left.first < right.first; });
    std::vector<std::string> keys;
    std::vector<std::string> rows;
    for (const auto& [packed, permutation] : sorted) {
        keys.push_back(packed_text(packed));
        rows.push_back(fmt::format("{{{}, {{{}}}, {{{}}}}}", keys.back(),
                                   stages.number[static_cast<std::size_t>(permutation->vertex)],
                                   stages.number[static_cast<std::size_t>(permutation->fragment)]));
    }
    values["permutation_count"] = std::to_string(rows.size());
    values["keys"] = cpp_list(keys);
    values["permutations"] = cpp_list(rows);
}

}  // namespace

void describe_permutations(const Composition& composition, const CppKey& key, TemplateValues& values) {
    Renumbering stages(composition.stages.size());
    for (const Permutation& permutation : composition.permutations) {
        stages.use(permutation.vertex);
        stages.use(permutation.fragment);
    }
    Renumbering pieces(composition.pieces.size());
    for (std::size_t index = 0; index < composition.stages.size(); ++index) {
        if (!stages.used[index]) continue;
        for (const int piece : composition.stages[index].pieces) pieces.use(piece);
    }
    Numbers parts(composition.pieces.size());
    const std::vector<std::string> rows = piece_rows(composition, pieces, parts);
    const StageLists lists = stage_lists(composition, stages, pieces, parts);

    const bool wide = rows.size() > std::numeric_limits<std::uint16_t>::max();
    values["index_type"] = wide ? "std::uint32_t" : "std::uint16_t";
    values["piece_count"] = std::to_string(rows.size());
    values["pieces"] = cpp_list(rows);
    values["stage_begin_count"] = std::to_string(lists.begins.size());
    values["stage_begins"] = numbers_text(lists.begins);
    values["index_count"] = std::to_string(lists.pieces.size());
    values["piece_lists"] = lists.pieces.empty() ? "" : numbers_text(lists.pieces);
    add_permutations(composition, key, stages, values);
}

}  // namespace gobo
