#include "gobo/declared_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/constraint.hpp"

namespace gobo {
namespace {

/// What the fragment and compute stages are given and give, and vertices by number.
constexpr std::array<std::string_view, 17> kBuiltins = {"gl_FragDepth",
                                                        "gl_FragCoord",
                                                        "gl_PointCoord",
                                                        "gl_FrontFacing",
                                                        "gl_VertexID",
                                                        "gl_InstanceID",
                                                        "gl_VertexIndex",
                                                        "gl_InstanceIndex",
                                                        "gl_SampleID",
                                                        "gl_SamplePosition",
                                                        "gl_Layer",
                                                        "gl_PrimitiveID",
                                                        "gl_ClipDistance[]",
                                                        "gl_GlobalInvocationID",
                                                        "gl_LocalInvocationID",
                                                        "gl_LocalInvocationIndex",
                                                        "gl_WorkGroupID"};

/// What stands between the brackets at the text's front; nothing where there are none. Takes them away.
std::optional<std::string_view> take_subscript(std::string_view& text) {
    if (!text.starts_with('[')) return std::nullopt;
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view inside = text.substr(1, end - 1);
    text.remove_prefix(end + 1);
    return inside;
}

/// Why a name is not the declared one.
enum class Difference : std::uint8_t { none, other_name, beyond_the_array, element };

struct Match {
    Difference difference = Difference::none;
    int elements = 0;  ///< of the array that has no such element
    int element = 0;   ///< that one
};

Match match(std::string_view name, std::string_view declared, const NameRules& rules) {
    constexpr Match kOtherName{Difference::other_name};
    Match match;
    while (true) {
        const std::size_t plain = std::min(declared.find('['), declared.size());
        if (name.substr(0, plain) != declared.substr(0, plain)) return kOtherName;
        name.remove_prefix(plain);
        declared.remove_prefix(plain);
        if (declared.empty()) return name.empty() && !rules.is_array ? match : kOtherName;
        if (name.empty() && rules.is_array) return match;
        const bool ends_in_subscripts = declared.find('.') == std::string_view::npos;
        while (const auto extent = take_subscript(declared)) {
            if (name.empty() && rules.whole_arrays && ends_in_subscripts) return match;
            const auto subscript = take_subscript(name);
            if (!subscript) return kOtherName;
            if (subscript->empty()) continue;
            const auto index = number_from<int>(*subscript);
            if (!index || *index < 0) return kOtherName;
            const int size = number_from<int>(*extent).value_or(0);
            if (size > 0 && *index >= size)
                match = {Difference::beyond_the_array, size, *index};
            else if (!rules.elements && match.difference == Difference::none)
                match.difference = Difference::element;
        }
    }
}

/// "Lights.lights[4].color" as the table writes it: with [] for each extent, or of an array its name.
std::string as_written(std::string_view declared, const NameRules& rules) {
    std::string text = without_subscripts(declared);
    if (rules.is_array) text.resize(std::min(text.find('['), text.size()));
    return text;
}

/// Without subscripts and capitals.
std::string plain(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        if (take_subscript(name)) continue;
        text += static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
        name.remove_prefix(1);
    }
    return text;
}

std::string_view last_part(std::string_view name) {
    return name.substr(name.rfind('.') + 1);
}

std::string with_extents(std::string path, const std::vector<int>& extents) {
    for (const int extent : extents) path += fmt::format("[{}]", extent);
    return path;
}

/// "rays[1].origin" with the extents that its elements show: "rays[2].origin".
std::string with_shown_extents(std::string_view path) {
    std::string text;
    while (!path.empty()) {
        if (const auto index = take_subscript(path)) {
            text += fmt::format("[{}]", number_from<int>(*index).value_or(0) + 1);
            continue;
        }
        text += path.front();
        path.remove_prefix(1);
    }
    return text;
}

/// "ivec3" has 3.
std::size_t components_of(std::string_view vector_type) {
    return static_cast<std::size_t>(vector_type.back() - '0');
}

}  // namespace

void DeclaredNames::add(const std::string& path, const std::string& type, const std::vector<int>& extents,
                        const std::vector<Member>& members) {
    const std::string here = with_extents(path, extents);
    if (members.empty()) names_.push_back(here);
    if (members.empty() && type.find("vec") != std::string::npos)
        vectors_.emplace_back(here, components_of(type));
    for (const Member& member : members)
        add(here + "." + member.name, member.type, member.array, member.members);
}

void DeclaredNames::add(const Interface& interface) {
    for (const auto* const blocks : {&interface.blocks, &interface.storage_blocks, &interface.push_constants})
        for (const Block& block : *blocks) {
            for (const Member& member : block.members) {
                if (block.usage.anonymous) members_.insert(member.name);
                add(fmt::format("{}.{}", with_shown_extents(block.name), member.name), member.type,
                    member.array, member.members);
            }
        }
    for (const Uniform& uniform : interface.uniforms)
        add(uniform.name, uniform.type, uniform.array, uniform.members);
    for (const Sampler& sampler : interface.samplers) {
        const std::string path = with_extents(with_shown_extents(sampler.name), sampler.array);
        for (const std::string_view part : {"", ".r", ".g", ".b", ".a", ".side", ".levels"})
            names_.push_back(fmt::format("{}{}", path, part));
    }
    for (const auto* const variables : {&interface.inputs, &interface.outputs})
        for (const Variable& variable : *variables)
            add(with_shown_extents(variable.name), variable.type, variable.array, {});
}

bool DeclaredNames::has_root(std::string_view name) const {
    return std::ranges::any_of(
        names_, [root = root_of(name)](const std::string& declared) { return root_of(declared) == root; });
}

bool DeclaredNames::begins_with_member(std::string_view name) const {
    return members_.contains(root_of(name));
}

bool DeclaredNames::has(std::string_view name, const NameRules& rules) const {
    if (rules.builtins && std::ranges::find(kBuiltins, name) != kBuiltins.end()) return true;
    if (const auto part = component_name(name); rules.components && part)
        for (const auto& [declared, components] : vectors_)
            if (part->component < components &&
                match(part->of, declared, rules).difference == Difference::none)
                return true;
    int least = std::numeric_limits<int>::max();  // of arrays that are too short
    int most = 0;
    int element = 0;
    for (const std::string& declared : names_) {
        const Match found = match(name, declared, rules);
        if (found.difference == Difference::none) return true;
        if (found.difference != Difference::beyond_the_array) continue;
        least = std::min(least, found.elements);
        most = std::max(most, found.elements);
        element = found.element;
    }
    return least < most && element < counted_;
}

std::string DeclaredNames::help_for(std::string_view name, const NameRules& rules) const {
    if (name.starts_with("gl_"))
        return rules.builtins
                   ? "of what GLSL has built in, only what stages are given and gl_FragDepth have ranges"
                   : "name an attribute, a uniform or a sampler";
    int elements = 0;
    for (const std::string& declared : names_) {
        const Match found = match(name, declared, rules);
        if (found.difference == Difference::element)
            return fmt::format("write '{}', which stands for every element", as_written(declared, rules));
        if (rules.is_array && declared == name) return fmt::format("'{}' is no array", declared);
        elements = std::max(elements, found.elements);
    }
    if (elements > 0) return fmt::format("the array has {} elements, 0 to {}", elements, elements - 1);
    std::vector<std::string> known;
    for (const std::string& declared : names_)
        if (!rules.is_array || declared.find('[') != std::string::npos)
            known.push_back(as_written(declared, rules));
    for (const bool is_whole : {true, false})  // then behind a block's instance, or by the member alone
        for (const std::string& one : known)
            if (is_whole
                    ? plain(one) == plain(name)
                    : !name.empty() && !has_root(name) && plain(last_part(one)) == plain(last_part(name)))
                return fmt::format("did you mean '{}'?", one);
    if (const auto near = nearest(name, known)) return fmt::format("did you mean '{}'?", *near);
    std::vector<std::string> parts;
    for (const std::string& one : known) parts.push_back(plain(last_part(one)));
    if (const auto near = nearest(plain(last_part(name)), parts); near && !name.empty() && !has_root(name))
        return fmt::format("did you mean '{}'?",
                           known[static_cast<std::size_t>(std::ranges::find(parts, *near) - parts.begin())]);
    return "gobo reflect lists the names that there are";
}

}  // namespace gobo
