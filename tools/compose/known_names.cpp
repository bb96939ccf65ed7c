#include "compose/known_names.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/scan_piece.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

struct Named {
    std::string name;
    std::string table;
    Place place;
};

std::vector<Named> names_of(const Family& family) {
    std::vector<Named> names;
    // Of a constraint, "unit(normal)", what stands between its brackets.
    for (const Domain& domain : family.domains)
        names.push_back({domain.name.substr(domain.name.find('(') + 1), "[domain]", domain.place});
    for (const RenderValue& value : family.render) names.push_back({value.name, "[render]", value.place});
    for (const Relation& relation : family.relations) {
        for (const auto* const list : {&relation.names, &relation.turned_back})
            for (const std::string& name : *list) names.push_back({name, "[[relations]]", relation.place});
        for (const RenderValue& value : relation.at)
            names.push_back({value.name, "[[relations]]", value.place});
    }
    for (const DescriptorSet& set : family.descriptor_sets)
        for (const std::string& name : set.holds)
            names.push_back({name, "[[descriptor_sets]]", set.holds_place});
    std::erase_if(names, [&](const Named& named) { return named.place.file != family.path; });
    return names;
}

/// The first part of "Lamps.lamps[0].color" that is not among the identifiers; empty where all are.
std::string unknown_part(const std::string& name, const std::set<std::string, std::less<>>& identifiers) {
    for (const std::string_view token : tokens_of(name))
        if (is_identifier(token) && !identifiers.contains(token)) return std::string(token);
    return {};
}

/// Whether names are joined, but by the macros of gobo's prologues.
bool joins_names(std::string_view text) {
    for (std::size_t at = text.find("##"); at != std::string_view::npos; at = text.find("##", at + 2)) {
        const std::string_view before = text.substr(0, at);
        if (!before.ends_with("PLACE_") && !before.ends_with("PLACE_OF_SAMPLER_")) return true;
    }
    return false;
}

}  // namespace

Diagnostics unknown_names(const Family& family, const SearchPath& search, const Composition& composition) {
    std::vector<Named> names = names_of(family);
    std::set<std::string, std::less<>> identifiers;
    const auto drop_known = [&] {
        std::erase_if(names,
                      [&](const Named& named) { return unknown_part(named.name, identifiers).empty(); });
    };
    // What joins names by ## or replaces them has them nowhere in its text.
    bool is_rewritten = std::ranges::any_of(
        family.features, [](const Feature& feature) { return !feature.substituted.empty(); });
    for (const Piece& piece : composition.pieces) {
        for (const std::string_view name : identifiers_of(piece.text)) identifiers.emplace(name);
        is_rewritten = is_rewritten || joins_names(piece.text);
    }
    drop_known();
    if (names.empty() || is_rewritten) return {};
    identifiers.merge(identifiers_of_all_keys(family, search, composition.dialect));
    drop_known();
    Diagnostics errors;
    std::ranges::stable_sort(names, {}, [](const Named& named) { return named.place.line; });
    for (const Named& named : names) {
        const std::string part = unknown_part(named.name, identifiers);
        std::vector<std::string> known(identifiers.begin(), identifiers.end());
        std::ranges::stable_partition(known, [&](const std::string& name) { return name[0] == part[0]; });
        const auto near = nearest(part, known);
        const Diagnostics error =
            fail(named.place, "",
                 fmt::format("'{}' under {} is in none of the shaders", named.name, named.table),
                 near ? fmt::format("did you mean '{}'?", *near)
                      : "gobo reflect lists the names that there are")
                .value();
        errors.insert(errors.end(), error.begin(), error.end());
    }
    return errors;
}

}  // namespace gobo
