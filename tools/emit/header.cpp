#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "emit/emit.hpp"
#include "emit/reserved_names.hpp"
#include "emit/sections.hpp"
#include "family/constraint.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

/// Names that header.hpp.in uses in the namespace or as local names: nothing of the family's may hide them.
constexpr std::string_view kHeaderNames =
    "Key Permutation SceneState Settings Stage State attribute attributes before bits block blocks canonical "
    "changed check combination count declared describe_missing detail find found glm gobo key key_text left "
    "other output outputs "
    "permutations position reason right sampler samplers select settings state std std140 storage_blocks "
    "uniform "
    "uniforms "
    "wanted";

Result<std::string> namespace_of(const EmitInput& input) {
    if (input.cpp_namespace.empty()) {
        const std::string name = cpp_identifier(input.family.name);
        return is_global_name(name) ? name + "_" : name;
    }
    const std::vector<std::string> names = split(input.cpp_namespace, ':');
    if (join(names, "::") == input.cpp_namespace && std::ranges::all_of(names, is_cpp_identifier)) {
        // Within another namespace a header would find these there instead of the ones that it needs.
        const auto hides = [](const std::string& name) {
            return name == "std" || name == "glm" || name == "gobo";
        };
        const auto taken = std::ranges::find_if(names, hides);
        if (taken == names.end() && !is_global_name(names.front())) return input.cpp_namespace;
        return fail(
            Fault::usage,
            fmt::format("'{}' cannot be the namespace of a header: C++, GLM or gobo has a '{}' already",
                        input.cpp_namespace, taken == names.end() ? names.front() : *taken),
            "use another name, such as game::shaders");
    }
    return fail(Fault::usage, fmt::format("'{}' is not a valid C++ namespace", input.cpp_namespace),
                "use identifiers with '::' between them, such as game::shaders");
}

/// A name that differs where the header does, by its contents (FNV-1a): the inline namespace of two headers
/// of one family, so that programs may link both.
std::string contents_name(const HeaderTemplates& templates, const TemplateValues& values) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&hash](std::string_view text) {
        for (const char character : text)
            hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3U;
        hash = (hash ^ 0xffU) * 0x100000001b3U;  // no text holds this byte: "ab", "c" is not "a", "bc"
    };
    for (const auto& [name, part] : templates) add(part.text);
    for (const auto& [name, value] : values) add(value);
    return fmt::format("contents_{:016x}", hash);
}

/// The errors that a budget promises and the domain that they hold over, as lines of a comment; empty where
/// none is promised and no domain narrowed.
std::string promises_text(const EmitInput& input) {
    std::string text;
    for (const QualityChoice& choice : input.qualities)
        if (choice.promised_error)
            text += fmt::format("//     {:<10.3g} {}\n", *choice.promised_error,
                                cpp_comment(key_text(input.family, choice.key)));
    if (!text.empty())
        text =
            "//\n// At every input of the domain fragments err by no more than this beyond the roundings of "
            "floats, as a "
            "part of\n// the light that reaches the point, or of 1. check(block) tells what of a block lies "
            "outside the "
            "domain.\n" +
            text;
    if (!input.narrowed.empty()) text += "//\n// The domain is narrower than the family's:\n";
    for (const Domain& domain : input.narrowed)
        text += is_constraint(domain.name)
                    ? fmt::format("//     {}\n", cpp_comment(domain.name))
                    : fmt::format("//     {}: {}\n", cpp_comment(domain.name),
                                  cpp_comment(domain_text(input.family.domains, domain.name)));
    return text;
}

}  // namespace

Result<HeaderTemplates> read_header_templates(const FileSystem& files, const std::string& folder) {
    HeaderTemplates templates;
    for (const char* name : {"bytes", "check", "elements", "header", "modules", "source", "spirv",
                             "spirv_tables", "struct", "taker", "texts"}) {
        TextTemplate& part = templates[name];
        part.name =
            fmt::format("{}/{}.{}.in", folder, name, name == std::string_view("source") ? "cpp" : "hpp");
        GOBO_TRY(part.text, files.read(part.name));
    }
    return templates;
}

std::string version_of(const Composition& composition) {
    if (composition.dialect != Dialect::own) return std::string(name_of(composition.dialect));
    for (const Piece& piece : composition.pieces) {
        if (piece.name != "prologue" || piece.text.find("#version ") == std::string::npos) continue;
        const GlslVersion version = version_of(piece.text);
        if (version.es && version.number == 300) return "es300";
        const bool has_profile = !version.profile.empty() && version.profile != "core";
        return fmt::format("{}{}", version.number, has_profile ? " " + version.profile : "");
    }
    return std::string(name_of(composition.dialect));
}

void add_table(TemplateValues& values, const std::string& name, const std::vector<std::string>& rows) {
    values[name + "_count"] = std::to_string(rows.size());
    values[name + "s"] = cpp_list(rows);
}

Result<EmittedCpp> emit_header(const EmitInput& input, const HeaderTemplates& templates) {
    const Family& family = input.family;
    TemplateValues values;
    values["family"] = cpp_comment(family.name);
    // Functions that read tables of a source file cannot be constant.
    values["lookup"] = input.split_from.empty() ? "constexpr" : "inline";
    GOBO_TRY(values["namespace"], namespace_of(input));
    const Dialect dialect = input.composition.dialect;
    values["dialect"] = dialect == Dialect::vulkan     ? "SPIR-V for Vulkan"
                        : dialect == Dialect::gl_spirv ? "SPIR-V for OpenGL"
                                                       : "GLSL " + cpp_comment(version_of(input.composition));

    std::vector<std::string> taken = split(kHeaderNames, ' ');
    if (is_spirv(dialect))
        for (const char* name : {"descriptors", "descriptor_set", "push_constants", "specialization",
                                 "specialization_constants", "vertex_inputs"})
            taken.emplace_back(name);
    CppScope scope({taken.begin(), taken.end()});
    const CppKey key = name_key(family, scope);
    std::vector<Rule> rules;
    std::ranges::copy_if(family.rules, std::back_inserter(rules), [&](const Rule& rule) {
        return applies_in(rule, name_of(input.composition.dialect));
    });
    GOBO_TRY_DO(key_section(rules, key, templates, values));
    const Interface interface = with_places(input.interface);
    const Declarations declarations(input);
    GOBO_TRY(const std::vector<CppBlock> blocks,
             block_section(interface, family.domains, declarations, templates, scope, values));
    GOBO_TRY_DO(check_section(blocks, interface, family.domains, templates, values));
    interface_section(interface, family.domains, declarations, dialect, values);
    declaration_section(declarations, interface, values);
    GOBO_TRY_DO(permutation_section(input, key, declarations, templates, values));
    GOBO_TRY_DO(spirv_section(input, interface, key, declarations, templates, values));
    values["promises"] = promises_text(input);
    values["contents"] = contents_name(templates, values);
    EmittedCpp emitted;
    GOBO_TRY(emitted.header, fill(templates.at("header"), values));
    if (input.split_from.empty()) return emitted;
    values["header"] = input.split_from;
    GOBO_TRY(emitted.source, fill(templates.at("source"), values));
    return emitted;
}

}  // namespace gobo
