#include "compose/specialized_counts.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo {

std::map<int, int> specialized_counts(const Family& family, Dialect dialect) {
    std::map<int, int> ids;
    for (std::size_t i = 0; i < family.features.size() && is_spirv(dialect); ++i)
        if (family.features[i].is_specialized) ids.emplace(static_cast<int>(i), static_cast<int>(ids.size()));
    return ids;
}

std::string with_largest_counts(const std::string& text, const Family& family,
                                const std::map<int, int>& counts) {
    if (counts.empty()) return text;
    Substitutions largest;
    for (const auto& [feature, id] : counts) {
        const std::string& macro = family.features[feature].macro;
        largest.emplace_back(macro, fmt::format("{}{}", macro, kLargest));
    }
    std::string result;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        const std::string line = text.substr(start, end - start);
        std::string_view directive = trim(line);
        const bool is_directive = directive.starts_with('#');
        if (is_directive) directive = trim(directive.substr(1));
        const bool is_condition =
            is_directive && (directive.starts_with("if") || directive.starts_with("elif"));
        result += (is_condition ? substituted(line, largest) : line) + "\n";
        start = end + 1;
    }
    return result;
}

std::string count_text(const Feature& count, const std::string& value, std::optional<int> id) {
    if (!id) return fmt::format("#define {0} {1}\n#define {0}{2} {1}\n", count.macro, value, kLargest);
    return fmt::format("#define {0}{1} {2}\nlayout(constant_id = {3}) const int {0} = {2};\n", count.macro,
                       kLargest, count.values.back(), *id);
}

std::set<std::uint32_t> count_ids(std::string_view prologue) {
    constexpr std::string_view kBefore = "layout(constant_id = ";
    std::set<std::uint32_t> ids;
    for (std::size_t at = prologue.find(kBefore); at != std::string_view::npos;
         at = prologue.find(kBefore, at + 1)) {
        const std::string_view digits = prologue.substr(at + kBefore.size());
        std::uint32_t id = 0;
        std::from_chars(digits.data(), digits.data() + digits.size(), id);
        ids.insert(id);
    }
    return ids;
}

Result<std::map<int, int>> CountSpecializer::in_stages(const Key& key,
                                                       const std::vector<Placement>& placements,
                                                       const std::vector<int>& read,
                                                       const PieceLibrary& library) {
    std::map<int, int> specialized;
    for (const auto& [feature, id] : counts_)
        if (family_.features[feature].lowest + key[feature] > 0) specialized.emplace(feature, id);
    for (const int index : read) {
        const Varying& varying = family_.varyings[index];
        std::vector<std::string> names;
        std::size_t erased = 0;
        for (const int feature : varying.counts) {
            erased += specialized.erase(feature);
            names.push_back(family_.features[feature].name);
        }
        if (erased > 0)
            note(varying.place,
                 fmt::format(
                     "no specialisation constant, but a stage for each number of {}: the varying '{}' has "
                     "as many values",
                     join(names, ", "), varying.name),
                 {}, key);
    }
    for (const Placement& placement : placements)
        for (const int file : placement.files)
            for (const auto& [feature, number] : library.source(file).asks_for_counts) {
                if (!specialized.contains(feature)) continue;
                const Directive& directive = library.source(file).directives[number];
                GOBO_TRY(const bool is_same, holds_for_all_counts(directive, feature, key));
                if (is_same) continue;
                specialized.erase(feature);
                note(directive.place,
                     fmt::format(
                         "no specialisation constant, but a stage for each number of {}: this asks for more "
                         "than whether there is one",
                         family_.features[feature].name),
                     directive.line, key);
            }
    return specialized;
}

Diagnostics CountSpecializer::notes() const {
    Diagnostics all;
    for (const auto& [text, note] : notes_) all.push_back(note);
    return all;
}

Result<bool> CountSpecializer::holds_for_all_counts(const Directive& directive, int feature, const Key& key) {
    if (directive.word == "ifdef" || directive.word == "ifndef") return true;
    if (directive.word != "if" && directive.word != "elif") return false;
    const auto mentioned = identifiers_of(directive.rest);
    std::string others;
    for (std::size_t i = 0; i < key.size(); ++i) {
        const Feature& other = family_.features[i];
        if (static_cast<int>(i) == feature || other.macro.empty() || !mentioned.contains(other.macro))
            continue;
        if (const auto text = other.text_of(key[i]))
            others += fmt::format("#define {} {}\n", other.macro, *text);
    }
    const auto [known, is_new] = same_for_counts_.try_emplace({&directive, feature, others}, true);
    if (!is_new) return known->second;
    std::set<Known> values;
    const Feature& count = family_.features[feature];
    for (std::size_t value = 0; value < count.values.size(); ++value) {
        if (count.lowest + static_cast<int>(value) == 0) continue;
        const Conditions conditions(
            fmt::format("{}#define {} {}\n", others, count.macro, count.values[value]), false);
        GOBO_TRY(const Known found, conditions.value_of(directive));
        values.insert(found ? Known(*found != 0 ? 1 : 0) : found);
    }
    return known->second = values.size() < 2;
}

void CountSpecializer::note(const Place& place, std::string message, std::string_view line, const Key& key) {
    const auto [known, is_new] =
        notes_.try_emplace(fmt::format("{}:{}: {}", place.file, place.line, message));
    Diagnostic& note = known->second;
    if (!is_new) {
        ++note.more_keys;
        return;
    }
    note = fail(place, line, std::move(message), "").value().front();
    note.severity = Severity::note;
    note.subject = key_text(family_, key);
}

}  // namespace gobo
