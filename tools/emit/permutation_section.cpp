#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>

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

/// Adds the texts of a piece, which fits no single literal where it is long, and their numbers.
void add_texts(const Piece& piece, std::vector<std::string>& rows, Numbers& numbers) {
    int line = 1;
    for (const std::string_view text : cut_for_literals(piece.text)) {
        numbers.push_back(rows.size());
        rows.push_back(fmt::format("{{{}, {{{}, {}}}, {}}}", cpp_literal(piece.name), cpp_literal(text),
                                   text.size(), line));
        line += static_cast<int>(std::ranges::count(text, '\n'));
    }
}

/// Where a list of pieces is cut into runs: behind every fourth piece or so, by the piece alone, so that
/// lists with the same pieces in a row have the same runs.
bool ends_run(std::size_t piece) {
    return (piece * 2654435761U >> 8U) % 4 == 0;
}

/// Lists of pieces as lists of runs; each distinct run stands once.
class Runs {
  public:
    /// The runs of a list, by number.
    Numbers cut(const Numbers& list) {
        Numbers numbers;
        Numbers run;
        for (std::size_t i = 0; i < list.size(); ++i) {
            run.push_back(list[i]);
            if (!ends_run(list[i]) && i + 1 < list.size()) continue;
            const auto [place, is_new] = numbers_.try_emplace(run, numbers_.size());
            if (is_new) {
                begins_.push_back(pieces_.size());
                std::ranges::copy(run, std::back_inserter(pieces_));
            }
            numbers.push_back(place->second);
            run.clear();
        }
        return numbers;
    }
    /// Where each begins in pieces(), and where the last one ends.
    [[nodiscard]] Numbers begins() const {
        Numbers begins = begins_;
        begins.push_back(pieces_.size());
        return begins;
    }
    [[nodiscard]] const Numbers& pieces() const { return pieces_; }

  private:
    std::map<Numbers, std::size_t> numbers_;
    Numbers begins_;
    Numbers pieces_;
};

void add_numbers(TemplateValues& values, const std::string& name, const Numbers& numbers) {
    values[name + "_count"] = std::to_string(numbers.size());
    values[name + "s"] = numbers_text(numbers);
}

}  // namespace

void permutation_section(const Composition& composition, const CppKey& key, const Declarations& declarations,
                         TemplateValues& values) {
    std::set<int> used;  // stages
    std::vector<std::pair<PackedKey, const Permutation*>> sorted;
    for (const Permutation& permutation : composition.permutations) {
        used.insert({permutation.vertex, permutation.fragment});
        sorted.emplace_back(pack(permutation.key, key), &permutation);
    }
    std::ranges::sort(sorted);

    std::map<int, Numbers> texts_of;  // each piece that is used
    for (const int stage : used)
        for (const int piece : composition.stage(stage).pieces) texts_of[piece];
    std::vector<std::string> texts;
    for (auto& [piece, numbers] : texts_of) add_texts(composition.piece(piece), texts, numbers);

    Runs runs;
    Numbers stage_begins;
    Numbers run_lists;
    std::map<int, std::size_t> stage_numbers;
    for (const int stage : used) {
        stage_numbers[stage] = stage_begins.size();
        stage_begins.push_back(run_lists.size());
        Numbers list;
        for (const int piece : composition.stage(stage).pieces)
            std::ranges::copy(texts_of[piece], std::back_inserter(list));
        std::ranges::copy(runs.cut(list), std::back_inserter(run_lists));
    }
    stage_begins.push_back(run_lists.size());

    std::vector<std::string> keys;
    std::vector<std::string> rows;
    for (const auto& [packed, permutation] : sorted) {
        const auto number = static_cast<std::size_t>(permutation - composition.permutations.data());
        const std::string combination = declarations.differing().empty()
                                            ? std::string()
                                            : fmt::format(", {}", declarations.combination_of(number));
        keys.push_back(packed_text(packed));
        rows.push_back(fmt::format("{{{}, {{{}}}, {{{}}}{}}}", rows.size(),
                                   stage_numbers[permutation->vertex], stage_numbers[permutation->fragment],
                                   combination));
    }
    const std::size_t most = std::max(texts.size(), runs.begins().size());
    const bool is_wide = most > std::numeric_limits<std::uint16_t>::max();
    values["index_type"] = is_wide ? "std::uint32_t" : "std::uint16_t";
    add_numbers(values, "stage_begin", stage_begins);
    add_numbers(values, "run_list", run_lists);
    add_numbers(values, "run_begin", runs.begins());
    add_numbers(values, "run_piece", runs.pieces());
    values["keys"] = cpp_list(keys);
    add_table(values, "piece", texts);
    add_table(values, "permutation", rows);
}

}  // namespace gobo
