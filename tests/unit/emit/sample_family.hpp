// Families and interfaces made by hand for the tests of what gobo emits.
#pragma once

#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "emit/emit.hpp"
#include "family/family.hpp"
#include "family/key.hpp"
#include "reflect/interface.hpp"

namespace gobo::sample {

inline Feature choice(const std::string& name, const std::vector<std::string>& values) {
    Feature feature;
    feature.name = name;
    feature.values = values;
    return feature;
}

inline Feature count(const std::string& name, int largest) {
    Feature feature;
    feature.name = name;
    feature.kind = FeatureKind::count;
    for (int value = 0; value <= largest; ++value) feature.values.push_back(std::to_string(value));
    return feature;
}

inline Feature define(const std::string& name) {
    Feature feature;
    feature.name = name;
    feature.kind = FeatureKind::define;
    feature.values = {"off", "on"};
    return feature;
}

/// A condition as a family file spells it.
inline Expression condition(const Family& family, const std::string& text) {
    return parse_expression(text, family.features, {}, Fault::input).value();
}

inline Rule defaults(const Family& family, const std::string& when,
                     const std::vector<std::string>& features) {
    Rule rule;
    rule.when = condition(family, when);
    for (const std::string& feature : features) rule.defaults.push_back(family.index_of(feature).value());
    return rule;
}

inline Rule forbid(const Family& family, const std::string& when, const std::string& reason) {
    Rule rule;
    rule.kind = Rule::Kind::forbid;
    rule.when = condition(family, when);
    rule.reason = reason;
    return rule;
}

inline Member member(const std::string& name, const std::string& type, int offset) {
    Member result;
    result.name = name;
    result.type = type;
    result.offset = offset;
    return result;
}

inline Member array(Member element, const std::vector<int>& extents, int stride) {
    element.array = extents;
    element.array_stride = stride;
    return element;
}

inline Member matrix(const std::string& name, const std::string& type, int offset, bool row_major = false) {
    Member result = member(name, type, offset);
    result.matrix_stride = 16;
    result.row_major = row_major;
    return result;
}

inline Member structure(const std::string& name, const std::string& type, int offset,
                        const std::vector<Member>& members) {
    Member result = member(name, type, offset);
    result.members = members;
    return result;
}

inline Block block(const std::string& name, int binding, int size, const std::vector<Member>& members) {
    Block result;
    result.name = name;
    result.binding = binding;
    result.size = size;
    result.members = members;
    return result;
}

/// Everything that emit_header() takes.
struct Built {
    Family family;
    Composition composition;
    Interface interface;
    std::vector<Differing> differing = {};

    [[nodiscard]] EmitInput input(const std::string& cpp_namespace = {}) const {
        return {family, composition, interface, cpp_namespace, {}, differing};
    }
};

/// Composes keys as text: the vertex stage is shared, each fragment stage is a prologue, a piece of its own
/// and the vertex stage's last piece.
void compose_keys(Built& built, const std::vector<std::string>& keys);

/// A small `lit`: choices, counts, rules, and the blocks of lights and fog.
Built lit();

/// The same family later: one feature more (before the others, so that every packed key changes), one value
/// more (before the one in use), and one permutation more.
Built grown_lit();

/// Names that C++ reserves or that clash, more than 64 bits of features, and every kind of member.
Built nasty();

/// Names that other people's headers make macros.
Built macros();

/// Arrays and matrices of every kind that std140 pads, and a block whose offsets do not rise.
Built arrays();

/// A family without features, with one permutation and an empty interface.
Built bare();

/// Permutations of a family like lit in full, of thirteen pieces each: as many as a large application would
/// build.
Built large(std::size_t permutations);

/// GLSL 330 that a driver can draw with, and a permutation that does not compile.
Built drawn();

}  // namespace gobo::sample
