#include "emit/header.hpp"

#include <fmt/format.h>

#include "core/text.hpp"
#include "compose/dialect.hpp"
#include "emit/check_section.hpp"
#include "emit/interface_section.hpp"
#include "emit/key_section.hpp"
#include "emit/permutation_section.hpp"
#include "emit/state_section.hpp"
#include "emit/struct_section.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

/// Names that header.hpp.in uses in the namespace or as local names: nothing of the family's may hide them.
CppScope header_scope() {
    return CppScope({"Key",
                     "Permutation",
                     "Stage",
                     "attribute",
                     "attributes",
                     "bits",
                     "block",
                     "blocks",
                     "canonical",
                     "detail",
                     "find",
                     "describe_missing",
                     "glm",
                     "gobo",
                     "key",
                     "key_text",
                     "left",
                     "output",
                     "outputs",
                     "permutations",
                     "position",
                     "reason",
                     "right",
                     "sampler",
                     "samplers",
                     "std",
                     "std140",
                     "uniforms",
                     "wanted",
                     "found",
                     "before",
                     "changed",
                     "count",
                     "check",
                     "select",
                     "SceneState",
                     "State",
                     "Settings",
                     "state",
                     "settings"});
}

Result<std::string> namespace_of(const EmitInput& input) {
    if (input.cpp_namespace.empty()) return cpp_identifier(input.family.name);
    std::string_view rest = input.cpp_namespace;
    while (true) {
        const auto end = rest.find("::");
        if (!is_cpp_identifier(rest.substr(0, end))) {
            return fail(Fault::usage, fmt::format("'{}' is no C++ namespace", input.cpp_namespace),
                        "use identifiers with '::' between them, such as game::shaders");
        }
        if (end == std::string_view::npos) return input.cpp_namespace;
        rest.remove_prefix(end + 2);
    }
}

std::vector<Rule> rules_of(const Family& family, Dialect dialect) {
    std::vector<Rule> rules;
    for (const Rule& rule : family.rules) {
        if (applies_in(rule, name_of(dialect))) rules.push_back(rule);
    }
    return rules;
}

}  // namespace

std::string version_of(const Composition& composition) {
    if (composition.dialect != Dialect::own || composition.pieces.empty()) {
        return std::string(name_of(composition.dialect));
    }
    constexpr std::string_view directive = "#version ";
    for (const Piece& piece : composition.pieces) {
        const auto found = piece.text.find(directive);
        if (found == std::string::npos) continue;
        const auto begin = found + directive.size();
        const std::string version(
            trim(std::string_view(piece.text).substr(begin, piece.text.find('\n', begin) - begin)));
        return version == "300 es" ? "es300" : version.substr(0, version.find(" core"));
    }
    return std::string(name_of(composition.dialect));
}

Result<std::string> emit_header(const EmitInput& input, const HeaderTemplates& templates) {
    const Result<std::string> cpp_namespace = namespace_of(input);
    if (!cpp_namespace) return cpp_namespace;
    TemplateValues values;
    values["family"] = input.family.name;
    values["namespace"] = *cpp_namespace;
    values["dialect"] = version_of(input.composition);

    CppScope scope = header_scope();
    const CppKey key = name_key(input.family, scope);
    describe_key(input.family, rules_of(input.family, input.composition.dialect), key, values);
    const Interface interface = with_places(input.interface);
    Result<StructSection> structs =
        struct_section(interface.blocks, input.family.domains, templates.structure, scope);
    if (!structs) return tl::make_unexpected(structs.error());
    values["structs"] = std::move(structs->text);
    values["checks"] = check_section(structs->blocks, input.family.domains);
    describe_interface(interface, input.family.domains, values);
    describe_permutations(input.composition, key, values);
    describe_state(input.family, key, values);
    return fill(templates.header, values);
}

}  // namespace gobo
