#include "lab/render/resolve.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

std::string head_of(std::string_view name) {
    return std::string(name.substr(0, name.find_first_of(".[")));
}

/// An error where the interface has the block or uniform, but not what the value names in it.
Result<void> check_name(const std::vector<Leaf>& leaves, const RenderValue& value) {
    const std::string plain = without_subscripts(value.name);
    std::vector<std::string> known;
    for (const Leaf& leaf : leaves) {
        const std::string name = without_subscripts(leaf.name);
        if (name == plain || name + "[]" == plain) return {};  // an element beyond the array's extent
        if (head_of(leaf.name) == head_of(value.name)) known.push_back(name);
    }
    if (known.empty()) return {};
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    Diagnostic diagnostic;
    diagnostic.place = value.place;
    diagnostic.message = fmt::format("'{}' has no member '{}'", head_of(value.name), value.name);
    diagnostic.help = suggestion(plain, known);
    return fail(std::move(diagnostic));
}

tl::unexpected<Diagnostics> cannot_supply(const Leaf& leaf, const RenderValue& value) {
    Diagnostic diagnostic;
    diagnostic.place = value.place;
    const std::vector<std::string>& known = uniform_sources();
    if (std::find(known.begin(), known.end(), value.source) == known.end()) {
        diagnostic.message = fmt::format("unknown source '{}' for '{}'", value.source, value.name);
        diagnostic.help = suggestion(value.source, known);
    } else {
        diagnostic.message = fmt::format("the source '{}' with {} numbers cannot supply '{}' of type {}",
                                         value.source, value.numbers.size(), value.name, leaf.type);
        diagnostic.help = "eye_point and eye_direction need numbers = [x, y, z] and give vectors";
        if (!value.source.starts_with("eye_"))
            diagnostic.help = "matrices go to matrices, vectors to vectors";
    }
    return fail(std::move(diagnostic));
}

Result<Assignment> assign(const Leaf& leaf, const RenderValue& value, const ViewedObject& object) {
    Assignment assignment{leaf, value.numbers};
    const auto type = value_type(leaf.type);
    if (!value.source.empty() && type) {
        const auto numbers = source_value(value.source, value.numbers, object, *type);
        if (!numbers) return cannot_supply(leaf, value);
        assignment.numbers = *numbers;
    }
    if (const auto checked = check(assignment, value.place); !checked) return tl::unexpected(checked.error());
    return assignment;
}

/// What the usual spelling of the uniform's name tells, if it fits the type.
std::optional<Assignment> guess(const Leaf& leaf, const ViewedObject& object) {
    const std::string_view source = uniform_source_of(leaf.name);
    const auto type = value_type(leaf.type);
    if (source.empty() || !type || leaf.is_array || type->component != Component::float32)
        return std::nullopt;
    const auto numbers = source_value(source, {}, object, *type);
    return numbers ? std::optional(Assignment{leaf, *numbers}) : std::nullopt;
}

Diagnostics warnings_for(const std::set<std::string>& names) {
    Diagnostics warnings;
    for (const std::string& name : names) {
        Diagnostic warning;
        warning.severity = Severity::warning;
        warning.message = fmt::format("'{}' has no value and stays 0", name);
        warning.help = "give it one under [render] in the family file";
        warnings.push_back(std::move(warning));
    }
    return warnings;
}

}  // namespace

Result<ResolvedUniforms> resolve_uniforms(const Interface& interface, const std::vector<RenderValue>& values,
                                          const ViewedObject& object) {
    const std::vector<Leaf> leaves = leaves_of(interface);
    ResolvedUniforms resolved;
    std::set<std::string> without_value;
    for (const Leaf& leaf : leaves) {
        if (auto guessed = guess(leaf, object)) {
            resolved.assignments.push_back(std::move(*guessed));
        } else {
            without_value.insert(without_subscripts(leaf.name));
        }
    }
    for (const RenderValue& value : values) {
        const auto leaf = find_leaf(leaves, value.name);
        if (!leaf) {
            if (const auto known = check_name(leaves, value); !known) return tl::unexpected(known.error());
            continue;
        }
        auto assignment = assign(*leaf, value, object);
        if (!assignment) return tl::unexpected(assignment.error());
        resolved.assignments.push_back(std::move(*assignment));
        std::string name = without_subscripts(leaf->name);
        without_value.erase(name);
        if (name.ends_with("[]")) without_value.erase(name.substr(0, name.size() - 2));
    }
    resolved.warnings = warnings_for(without_value);
    return resolved;
}

}  // namespace gobo
