#include "gobo/literal_counts.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/specialized_counts.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "validate/batch.hpp"
#include "validate/declaration.hpp"
#include "validate/glslang_log.hpp"

namespace gobo {
namespace {

/// The keys that are fine with these counts as numbers, of those given.
std::vector<Key> valid_with(const LoadedFamily& family, const std::vector<Key>& keys,
                            const std::set<int>& counts, const ValidateOptions& options) {
    LiteralCounts literal;
    for (const Key& key : keys) literal[key] = counts;
    const auto composition =
        compose(family.family, keys, family.search, family.dialect, family.comments, literal);
    if (!composition) return {};
    const Validated validated = validate(family.family, *composition, options);
    std::vector<Key> valid;
    for (std::size_t i = 0; i < composition->permutations.size(); ++i)
        if (!validated.failed.contains(i)) valid.push_back(composition->permutations[i].key);
    return valid;
}

/// What is wrong with a constant, in a few words.
std::string reason_of(const Diagnostic& error) {
    const std::string line = error.message.substr(0, error.message.find('\n'));
    if (line.starts_with("a constant ")) return line;
    if (is_of_stopped_glslang(error)) return "with a constant " + line;
    return "with a constant: " + line;
}

/// Why keys have numbers: what is wrong with them as constants.
Diagnostics notes_of(const Diagnostics& errors, const Family& family, const LiteralCounts& literal) {
    Diagnostics notes;
    for (const Diagnostic& error : errors) {
        const Result<Key> key = parse_key(family, error.subject);
        const auto counts = key ? literal.find(*key) : literal.end();
        if (error.severity != Severity::error || counts == literal.end()) continue;
        std::vector<std::string> names;
        for (const int feature : counts->second)
            names.push_back(family.features[static_cast<std::size_t>(feature)].name);
        Diagnostic& note = notes.emplace_back(error);
        note.severity = Severity::note;
        note.fault = Fault::input;
        const std::string counts_text = join(names, " and ");
        note.message = fmt::format("no specialisation constant, but a stage for each number of {}; {}",
                                   counts_text, reason_of(error));
        note.help.clear();
        if (is_of_stopped_glslang(error) && error.place.line == 0)
            note.help = fmt::format(
                "a constant can end a loop and be an array's size: look where the stage asks for {} "
                "otherwise",
                counts_text);
    }
    return notes;
}

}  // namespace

Validated validate_with_counts(const LoadedFamily& family, Composition& composition,
                               const ValidateOptions& options) {
    Validated validated = validate(family.family, composition, options);
    std::vector<Key> left;
    for (const std::size_t i : validated.failed)
        if (!composition.permutations[i].specialized.empty()) left.push_back(composition.permutations[i].key);
    // Where constant_ids clash the shader states another.
    const bool is_of_ids = std::ranges::any_of(validated.diagnostics, [](const Diagnostic& found) {
        return found.severity == Severity::error && found.message.find("constant_id") != std::string::npos;
    });
    if (left.empty() || is_of_ids) return validated;
    std::set<int> all;
    for (const auto& [feature, id] : specialized_counts(family.family, family.dialect)) all.insert(feature);
    left = valid_with(family, left, all, options);
    if (left.empty()) return validated;

    // One of the counts may be the only reason.
    LiteralCounts literal;
    for (const int feature : all) {
        if (all.size() == 1 || left.empty()) break;
        for (const Key& key : valid_with(family, left, {feature}, options)) {
            literal[key] = {feature};
            std::erase(left, key);
        }
    }
    for (const Key& key : left) literal[key] = all;

    std::vector<Key> keys;
    for (const Permutation& permutation : composition.permutations) keys.push_back(permutation.key);
    auto literal_there =
        compose(family.family, keys, family.search, family.dialect, family.comments, literal);
    if (!literal_there) return validated;
    composition = *std::move(literal_there);
    append(composition.notes, notes_of(validated.diagnostics, family.family, literal));
    return validate(family.family, composition, options);
}

Diagnostics clashes_with_counts(const LoadedFamily& family, const Composition& composition,
                                const Validated& validated) {
    DiagnosticGroups groups(family.family);
    for (const Permutation& permutation : composition.permutations)
        for (const int number : permutation.stages.values) {
            if (number < 0) continue;
            for (const SpecializationConstant& constant :
                 validated.stage(number).interface.specialization_constants) {
                const auto count = family.count_constants.find(constant.id);
                if (count == family.count_constants.end() || count->second == constant.name) continue;
                groups.add(
                    diagnostic_at(
                        declaration_of(constant.name, "constant_id", pieces_of(composition, number)),
                        Severity::error, id_of_count(constant.id, count->second), std::string(kIdsOfCounts)),
                    permutation.key);
            }
        }
    return groups.result();
}

}  // namespace gobo
