#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/sections.hpp"
#include "emit/stage_columns.hpp"

namespace gobo {
namespace {

using PackedKey = std::vector<std::uint64_t>;

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

constexpr std::size_t kDigits = 64;  ///< of NumberText in gobo/permutation.hpp: '0' to 'o'
constexpr std::size_t kNumbersInRow = 4000;

/// The tables that grow with the permutations: defined in struct Tables, or only declared there and defined
/// in a source file.
class GrowingTables {
  public:
    explicit GrowingTables(bool is_split) : is_split_(is_split) {}

    /// What stands in struct Tables.
    std::string add(std::string_view type, std::string_view name, std::string_view value) {
        if (!is_split_) return fmt::format("static constexpr {} {}{{ {} }};", type, name, value);
        definitions_ += fmt::format("const {} Tables::{}{{ {} }};\n", type, name, value);
        return fmt::format("static const {} {};", type, name);
    }
    std::string add_rows(std::string_view type, std::string_view name, const std::vector<std::string>& rows) {
        return add(fmt::format("std::array<{}, {}>", type, rows.size()), name, cpp_list(rows));
    }
    std::string add_numbers(std::string_view name, Numbers numbers);

    /// Those of the source file, with what they need before them.
    [[nodiscard]] std::string& definitions() { return definitions_; }
    [[nodiscard]] bool is_split() const { return is_split_; }

  private:
    bool is_split_;
    std::string definitions_;
};

/// As a NumberText.
std::string GrowingTables::add_numbers(std::string_view name, Numbers numbers) {
    if (numbers.empty()) numbers.push_back(0);  // an array has at least one element
    std::size_t digits = 1;
    for (std::size_t most = std::ranges::max(numbers); most >= kDigits; most /= kDigits) ++digits;
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i % kNumbersInRow == 0) rows.emplace_back();
        const std::size_t first = rows.back().size();
        rows.back().resize(first + digits);
        for (std::size_t digit = digits; digit-- > 0; numbers[i] /= kDigits)
            rows.back()[first + digit] = static_cast<char>('0' + numbers[i] % kDigits);
    }
    return add(fmt::format("gobo::runtime::NumberText<{}, {}>", digits, numbers.size()), name,
               fmt::format("{{\n        R\"({})\"}}", fmt::join(rows, ")\",\n        R\"(")));
}

/// The texts of pieces as rows of a table, each distinct one once.
class TextRows {
  public:
    /// The numbers of a piece's texts; cut at line ends where that lets pieces share more than it costs.
    Numbers add(const Piece& piece, bool is_cut) {
        Numbers numbers;
        for (const std::string_view part :
             is_cut ? lines_of(piece.text) : std::vector<std::string_view>{piece.text})
            for (const std::string_view text : cut_for_literals(part)) {
                const bool is_first = numbers.empty();
                const int line = is_first ? piece.first_line : 0;
                const auto [place, is_new] =
                    numbers_.try_emplace(std::tuple(std::string_view(piece.name), text, line), rows_.size());
                if (is_new)
                    rows_.push_back(fmt::format("{{{}, {{{}, {}}}, {}}}", cpp_literal(piece.name),
                                                cpp_literal(text), text.size(), line));
                numbers.push_back(place->second);
            }
        return numbers;
    }
    [[nodiscard]] const std::vector<std::string>& rows() const { return rows_; }

    /// Its lines, each with the empty ones before it.
    static std::vector<std::string_view> lines_of(std::string_view text) {
        std::vector<std::string_view> lines;
        while (!text.empty()) {
            const std::size_t end = text.find('\n', std::min(text.find_first_not_of('\n'), text.size()));
            lines.push_back(text.substr(0, end == std::string_view::npos ? end : end + 1));
            text.remove_prefix(lines.back().size());
        }
        return lines;
    }

  private:
    std::map<std::tuple<std::string_view, std::string_view, int>, std::size_t> numbers_;
    std::vector<std::string> rows_;
};

/// The names of those pieces that are shorter as lines that they share than each as a whole.
std::set<std::string_view> names_to_cut(const Composition& composition, const std::set<int>& pieces) {
    constexpr std::ptrdiff_t kRowSize = 40;  // of a row without its text, about
    std::map<std::string_view, std::ptrdiff_t> gains;
    std::set<std::pair<std::string_view, std::string_view>> lines;
    for (const int number : pieces) {
        const Piece& piece = composition.piece(number);
        std::ptrdiff_t& gain = gains[piece.name];
        gain += kRowSize + static_cast<std::ptrdiff_t>(piece.text.size());
        for (const std::string_view line : TextRows::lines_of(piece.text))
            if (lines.emplace(piece.name, line).second)
                gain -= kRowSize + static_cast<std::ptrdiff_t>(line.size());
    }
    std::set<std::string_view> names;
    for (const auto& [name, gain] : gains)
        if (gain > 0) names.insert(name);
    return names;
}

/// The stages that the permutations have, in the order of the pipeline, and whether some lack one of them.
struct HeaderStages {
    std::vector<StageKind> kinds;
    bool some_lack = false;
};

HeaderStages stages_of(const Composition& composition) {
    HeaderStages stages;
    for (const StageNames& stage : kStages) {
        const auto has = [&](const Permutation& permutation) { return permutation.stages[stage.kind] >= 0; };
        const auto count = std::ranges::count_if(composition.permutations, has);
        if (count > 0) stages.kinds.push_back(stage.kind);
        stages.some_lack |= count > 0 && count < std::ssize(composition.permutations);
    }
    const bool has_none = stages.kinds.empty();
    if (has_none) stages.kinds = {StageKind::vertex, StageKind::fragment};
    return stages;
}

/// The members of Permutation, and where they are not just the usual two a function that calls for each.
void add_members(const HeaderStages& stages, TemplateValues& values) {
    std::string& members = values["stage_members"];
    std::string calls;
    for (const StageKind kind : stages.kinds) {
        const std::string_view name = name_of(kind);
        members += fmt::format("    Stage {};\n", name);
        calls += fmt::format("        {0}callback(gobo::runtime::StageKind::{1}, {1});\n",
                             stages.some_lack ? fmt::format("if ({}.exists()) ", name) : "", name);
    }
    const bool are_usual = stages.kinds == std::vector{StageKind::vertex, StageKind::fragment};
    if (are_usual && !stages.some_lack) {
        values["stage_calls"] = "";
        return;
    }
    values["stage_calls"] = fmt::format(
        "    /// Calls `callback(gobo::runtime::StageKind, Stage)` for each stage that it has.\n"
        "    template <class Callback>\n"
        "    constexpr void for_each_stage(Callback&& callback) const {{\n{}    }}\n",
        calls);
}

}  // namespace

namespace {

/// The numbers by which the header knows the stages of the composition; a stage that is lacking is -1.
using HeaderNumbers = std::map<int, std::size_t>;

/// Each distinct module once.
Result<HeaderNumbers> modules_section(const std::set<int>& used, bool some_lack,
                                      const std::vector<std::span<const std::uint32_t>>& modules,
                                      const HeaderTemplates& templates, GrowingTables& tables,
                                      TemplateValues& values) {
    constexpr std::size_t kWordsInRow = 12;
    HeaderNumbers numbers;
    std::map<std::vector<std::uint32_t>, std::size_t> by_words;
    std::vector<std::string> rows;
    std::string words_text;
    for (const int stage : used) {
        const std::span<const std::uint32_t> words = modules[static_cast<std::size_t>(stage)];
        const auto [place, is_new] =
            by_words.try_emplace(std::vector<std::uint32_t>(words.begin(), words.end()), rows.size());
        numbers.emplace(stage, place->second);
        if (!is_new) continue;
        words_text += fmt::format("    static constexpr std::uint32_t words_{}[] = {{", rows.size());
        for (std::size_t i = 0; i < words.size(); ++i) {
            words_text += i % kWordsInRow == 0 ? "\n        " : " ";
            words_text += fmt::format("{:#x},", words[i]);
        }
        words_text += "\n    };\n";
        rows.push_back(fmt::format("{{words_{}, {}}}", rows.size(), words.size()));
    }
    if (some_lack) {
        numbers.emplace(-1, rows.size());
        rows.emplace_back("{nullptr, 0}");
    }
    TemplateValues own;
    own["words"] = tables.is_split() ? "" : words_text;
    if (tables.is_split()) tables.definitions() += words_text;
    own["modules"] = tables.add_rows("gobo::runtime::Module", "modules", rows);
    GOBO_TRY(values["stage_data"], fill(templates.at("modules"), own));
    return numbers;
}

/// Texts once, and stages as lists of them.
Result<HeaderNumbers> texts_section(const Composition& composition, const std::set<int>& used, bool some_lack,
                                    const HeaderTemplates& templates, GrowingTables& tables,
                                    TemplateValues& values) {
    std::set<int> pieces;
    std::map<StageKind, std::vector<int>> by_kind;
    for (const int stage : used) {
        const Stage& one = composition.stage(stage);
        by_kind[one.kind].push_back(stage);
        pieces.insert(one.pieces.begin(), one.pieces.end());
    }
    TextRows texts;
    std::map<int, Numbers> texts_of;
    const std::set<std::string_view> cut = names_to_cut(composition, pieces);
    for (const int number : pieces) {
        const Piece& piece = composition.piece(number);
        texts_of[number] = texts.add(piece, cut.contains(piece.name));
    }

    HeaderNumbers stage_numbers;
    std::vector<std::string> stage_tables;
    Numbers digits;
    Numbers first_lists;
    Numbers list_begins;
    Numbers list_pieces;
    for (const auto& [kind, stages] : by_kind) {
        stage_tables.push_back(
            fmt::format("{{{}, {}, {}, ", stage_numbers.size(), digits.size(), first_lists.size()));
        std::vector<Numbers> lists;
        for (const int stage : stages) {
            stage_numbers.emplace(stage, stage_numbers.size());
            Numbers& list = lists.emplace_back();
            for (const int piece : composition.stage(stage).pieces)
                std::ranges::copy(texts_of[piece], std::back_inserter(list));
        }
        const StageColumns table = columns_of(lists, kDigits);
        stage_tables.back() += fmt::format("{}}}", table.columns.size());
        for (const Numbers& row : table.rows) std::ranges::copy(row, std::back_inserter(digits));
        for (const std::vector<Numbers>& column : table.columns) {
            first_lists.push_back(list_begins.size());
            for (const Numbers& list : column) {
                list_begins.push_back(list_pieces.size());
                std::ranges::copy(list, std::back_inserter(list_pieces));
            }
        }
    }
    list_begins.push_back(list_pieces.size());
    if (some_lack) {  // a stage without texts
        stage_tables.push_back(fmt::format("{{{}, 0, 0, 0}}", stage_numbers.size()));
        stage_numbers.emplace(-1, stage_numbers.size());
    }
    TemplateValues own;
    own["stage_digits"] = tables.add_numbers("stage_digits", digits);
    own["first_lists"] = tables.add_numbers("first_lists", first_lists);
    own["list_begins"] = tables.add_numbers("list_begins", list_begins);
    own["list_pieces"] = tables.add_numbers("list_pieces", list_pieces);
    own["stage_tables"] = tables.add_rows("gobo::runtime::StageTable", "stage_tables", stage_tables);
    own["pieces"] = tables.add_rows("gobo::runtime::Piece", "pieces", texts.rows());
    GOBO_TRY(values["stage_data"], fill(templates.at("texts"), own));
    return stage_numbers;
}

}  // namespace

Result<void> permutation_section(const EmitInput& input, const CppKey& key, const Declarations& declarations,
                                 const HeaderTemplates& templates, TemplateValues& values) {
    const Composition& composition = input.composition;
    GrowingTables tables(!input.split_from.empty());
    std::set<int> used;  // stages
    std::vector<std::pair<PackedKey, const Permutation*>> sorted;
    for (const Permutation& permutation : composition.permutations) {
        for (const int stage : permutation.stages.values)
            if (stage >= 0) used.insert(stage);
        sorted.emplace_back(pack(permutation.key, key), &permutation);
    }
    std::ranges::sort(sorted);
    const HeaderStages stages = stages_of(composition);
    add_members(stages, values);
    GOBO_TRY(const HeaderNumbers stage_numbers,
             is_spirv(composition.dialect)
                 ? modules_section(used, stages.some_lack, input.modules, templates, tables, values)
                 : texts_section(composition, used, stages.some_lack, templates, tables, values));

    std::vector<std::string> keys;
    std::vector<std::string> rows;
    for (const auto& [packed, permutation] : sorted) {
        const auto number = static_cast<std::size_t>(permutation - composition.permutations.data());
        const std::string combination = declarations.differing().empty()
                                            ? std::string()
                                            : fmt::format(", {}", declarations.combination_of(number));
        keys.push_back(packed_text(packed));
        std::string numbers;
        for (const StageKind kind : stages.kinds)
            numbers += fmt::format(", {{{}}}", stage_numbers.at(permutation->stages[kind]));
        rows.push_back(fmt::format("{{{}{}{}}}", rows.size(), numbers, combination));
    }
    values["keys"] = tables.add_rows("Packed", "keys", keys);
    const std::string type = fmt::format("std::array<Permutation, {}>", rows.size());
    const std::string definition = fmt::format("{} permutations{{ {} }};", type, cpp_list(rows));
    values["permutation_count"] = std::to_string(rows.size());
    values["permutations"] = tables.is_split() ? fmt::format("extern const {} permutations;", type)
                                               : "inline constexpr " + definition;
    values["permutations_definition"] = "const " + definition;
    values["definitions"] = std::move(tables.definitions());
    return {};
}

}  // namespace gobo
