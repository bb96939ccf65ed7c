#include "gobo/known_names.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "compose/scan_piece.hpp"
#include "compose/set_names.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "family/constraint.hpp"
#include "family/key.hpp"
#include "gobo/declared_names.hpp"

namespace gobo {
namespace {

using Identifiers = std::set<std::string, std::less<>>;

struct Named {
    std::string name;
    std::string part;  ///< of a constraint such as "unit(normal)", what is looked for; else the name
    std::string table;
    NameRules rules;
    Place place;
};

constexpr NameRules kOfDomain{.builtins = true, .components = true};
constexpr NameRules kOfRender{.elements = true, .whole_arrays = true};
constexpr NameRules kOfRelation{.elements = true};
constexpr NameRules kOfTurn{};
constexpr NameRules kOfOrder{.is_array = true};

/// Of the family's own file, and of that of narrower domains.
std::vector<Named> names_of(const Family& family, const std::vector<Domain>& narrowed) {
    std::vector<Named> names;
    for (const Domain& domain : family.domains) {
        std::vector<std::string> parts = {domain.name};
        if (is_constraint(domain.name))
            if (const auto constraint = constraint_of(domain.name)) parts = constraint->names;
        for (const std::string& part : parts)
            if (!part.empty() || parts.size() == 1)  // of a comparison with a number that side is empty
                names.push_back({domain.name, part, "[domain]", kOfDomain, domain.place});
    }
    for (const RenderValue& value : family.render)
        names.push_back({value.name, value.name, "[render]", kOfRender, value.place});
    for (const Relation& relation : family.relations) {
        const NameRules& rules = relation.kind == Relation::Kind::any_order ? kOfOrder
                                 : relation.kind == Relation::Kind::adds    ? kOfRelation
                                                                            : kOfTurn;
        for (const auto* const list : {&relation.names, &relation.turned_back})
            for (const std::string& name : *list)
                names.push_back({name, name, "[[relations]]", rules, relation.place});
        for (const RenderValue& value : relation.at)
            names.push_back({value.name, value.name, "[[relations]]", kOfRelation, value.place});
    }
    const std::string& narrower = narrowed.empty() ? family.path : narrowed.front().place.file;
    std::erase_if(names, [&](const Named& named) {
        return named.place.file != family.path && named.place.file != narrower;
    });
    return names;
}

/// Whether all parts of "Lamps.lamps[0].color" are among the identifiers.
bool are_all_in(const Identifiers& identifiers, std::string_view name) {
    const std::vector<std::string_view> tokens = tokens_of(name);
    return std::ranges::any_of(tokens, is_identifier) &&
           std::ranges::all_of(tokens, [&](std::string_view token) {
               return !is_identifier(token) || identifiers.contains(token);
           });
}

/// The instances of blocks, behind which no name stands: "lights" of `uniform Lights { ... } lights[2];`.
void add_instances(std::string_view code, Identifiers& instances) {
    constexpr std::array<std::string_view, 4> kStorage = {"uniform", "buffer", "in", "out"};
    const std::vector<std::string_view> tokens = tokens_of(code);
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
        if (std::ranges::find(kStorage, tokens[i]) == kStorage.end() || tokens[i + 2] != "{") continue;
        const auto end = std::find(tokens.begin() + static_cast<std::ptrdiff_t>(i), tokens.end(), "}");
        if (end + 1 < tokens.end() && is_identifier(end[1])) instances.emplace(end[1]);
    }
}

}  // namespace

std::optional<Key> with_highest_counts(const LoadedFamily& family, Key key) {
    const std::vector<Feature>& features = family.family.features;
    for (std::size_t i = 0; i < features.size(); ++i)
        if (features[i].kind == FeatureKind::count) key[i] = static_cast<int>(features[i].values.size()) - 1;
    const Key valid = canonical(family.family, key, name_of(family.dialect));
    if (valid != key || forbidding_rule(family.family, key, name_of(family.dialect)) != nullptr)
        return std::nullopt;
    return key;
}

Diagnostics unknown_names(const LoadedFamily& family, const Composition& composition,
                          const Validated& validated, const InterfacesOfCover& more) {
    std::vector<Named> names = names_of(family.family, family.narrowed);
    Diagnostics errors = unknown_set_names(family.family, family.search, composition);
    if (names.empty()) return errors;
    int counted = 0;  // where a cover does not show how large arrays become
    const bool is_shown = with_highest_counts(family, default_key(family.family)).has_value();
    for (const Feature& feature : family.family.features)
        if (feature.kind == FeatureKind::count && !is_shown)
            counted += feature.lowest + static_cast<int>(feature.values.size()) - 1;
    DeclaredNames declared(counted);
    for (const ValidatedStage& stage : validated.stages) declared.add(stage.interface);
    Identifiers identifiers;
    Identifiers instances;
    // What joins names by ## or replaces them has them nowhere in its text.
    bool is_rewritten = std::ranges::any_of(
        family.family.features, [](const Feature& feature) { return !feature.substituted.empty(); });
    for (const Piece& piece : composition.pieces) {
        for (const std::string_view name : identifiers_of(piece.text)) identifiers.emplace(name);
        add_instances(piece.text, instances);
        is_rewritten = is_rewritten || joins_names(piece.text);
    }
    const auto is_declared = [&](const Named& named) { return declared.has(named.part, named.rules); };
    std::erase_if(names, is_declared);
    // Of what no key here declares, the texts tell whether another one may.
    bool is_of_all_keys = false;
    std::erase_if(names, [&](const Named& named) {
        const std::string root(root_of(named.part));
        if (root.empty() || declared.has_root(root) || declared.begins_with_member(root) ||
            (instances.contains(root) && root != named.part))
            return false;
        if (named.part.starts_with("gl_")) return false;
        if (is_rewritten || are_all_in(identifiers, named.part)) return true;
        if (!std::exchange(is_of_all_keys, true))
            for (const std::string& text :
                 texts_of_all_keys(family.family, family.search, composition.dialect))
                for (const std::string_view name : identifiers_of(text)) identifiers.emplace(name);
        return are_all_in(identifiers, named.part);
    });
    for (int strength = 1; strength <= 2 && !names.empty(); ++strength) {
        const bool may_be_there =
            std::ranges::any_of(names, [&](const Named& named) { return declared.has_root(named.part); });
        if (strength == 2 && !may_be_there) break;  // the first is for what is suggested, too
        for (const Interface& interface : more(strength)) declared.add(interface);
        std::erase_if(names, is_declared);
    }
    std::ranges::stable_sort(names, {}, [](const Named& named) { return named.place.line; });
    for (const Named& named : names) {
        append(errors, fail(named.place, "",
                            fmt::format("'{}' under {} is in none of the shaders", named.name, named.table),
                            declared.help_for(named.part, named.rules))
                           .value());
    }
    return errors;
}

}  // namespace gobo
