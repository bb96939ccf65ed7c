// check(block) of a generated header: whether an application's values are those that the shaders are made
// for.
#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/constraint_calls.hpp"
#include "emit/sections.hpp"
#include "family/constraint.hpp"
#include "reflect/interface.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

constexpr std::string_view kComponents = "xyzw";

std::string range_text(const Domain& domain) {
    std::string text =
        fmt::format("{}[{}, {}]", domain.of_length ? "length in " : "", domain.low, domain.high);
    for (const double value : domain.also) text += fmt::format(", or {}", value);
    if (!domain.last.empty()) text += fmt::format("; last [{}, {}]", domain.last[0], domain.last[1]);
    return text;
}

const Domain* domain_of(const std::vector<Domain>& domains, const std::string& path) {
    const auto name = [](const Domain& domain) { return without_indices(domain.name); };
    const auto domain = std::ranges::find(domains, without_indices(path), name);
    return domain == domains.end() ? nullptr : &*domain;
}

/// Where a member stands: for messages, in C++, and within which loops.
struct Spot {
    std::string path;        ///< "PointLights.lights[].color"
    std::string expression;  ///< "block.lights[i0].color"
    std::vector<std::string> indices;

    [[nodiscard]] std::string indent() const { return std::string(4 * (indices.size() + 1), ' '); }
};

/// A call for the member's numbers; nothing where the family declares no range for them.
std::string number_check(const Spot& spot, const std::vector<Domain>& domains) {
    std::string checks;
    const auto add = [&](const Domain& domain, std::string_view component, std::string_view call,
                         const std::string& what) {
        const std::string path = fmt::format("{}{}", spot.path, component);
        const std::string text = (domain.of_length ? "a " : "") + range_text(domain);
        checks += fmt::format(
            "{0}gobo::runtime::check_{9}(found, {1}, {{{2}}}, {3},\n{0}                            "
            "{{{4}, {5}, {6}, {{{7}}}, {8}}});\n",
            spot.indent(), cpp_literal(path), fmt::join(spot.indices, ", "), what, domain.low, domain.high,
            domain.of_length, fmt::join(domain.also, ", "), cpp_literal(text), call);
    };
    if (const Domain* const domain = domain_of(domains, spot.path))
        add(*domain, "", "member", spot.expression);
    for (std::size_t i = 0; i < kComponents.size(); ++i)
        if (const Domain* const own = domain_of_component(domains, spot.path, i))
            add(*own, fmt::format(".{}", kComponents[i]), "component",
                fmt::format("{}, {}", spot.expression, i));
    return checks;
}

/// The checks of a member, within a loop for each extent of its array; `count` bounds the outermost loop too
/// where it is given.
std::string member_checks(const CppMember& named, const Spot& parent, const std::vector<Domain>& domains,
                          const std::string& count) {
    Spot spot{parent.path + "." + named.member.name, parent.expression + "." + named.identifier,
              parent.indices};
    std::string head;
    std::string tail;
    for (std::size_t extent = 0; extent < named.member.array.size(); ++extent) {
        const std::string index = fmt::format("i{}", spot.indices.size());
        const std::string counted =
            extent == 0 && !count.empty() ? fmt::format("{} < {} && ", index, count) : "";
        head += fmt::format("{0}for (int {1} = 0; {2}{1} < {3}; ++{1}) {{\n", spot.indent(), index, counted,
                            named.member.array[extent]);
        tail = spot.indent() + "}\n" + tail;
        spot.path += "[]";
        spot.expression += "[" + index + "]";
        spot.indices.push_back(index);
    }
    const std::optional<GlslType> type = glsl_type(named.member.type);
    const bool is_number = type && type->scalar != Scalar::float16;  // of which there are only the bits
    std::string body = is_number ? number_check(spot, domains) : "";
    for (const CppMember& part : named.members) body += member_checks(part, spot, domains, "");
    return body.empty() ? body : head + body + tail;
}

/// The extent of the array that ends the block, of which an application may use less; 0 where there is none.
int counted_extent(const CppBlock& block) {
    return block.counted.empty() ? 0 : block.members.back().member.array.front();
}

/// Why a member of a block, at `path` below what holds `members`, cannot be checked; empty where it can be or
/// is not there.
std::string_view reason_of_member(const std::vector<Member>& members, std::string_view path,
                                  Constraint::Kind kind) {
    for (const Member& member : members) {
        if (path != member.name && !path.starts_with(member.name + ".")) continue;
        if (std::ranges::find(member.array, 0) != member.array.end()) return "is of an array without a size";
        if (!member.members.empty())
            return path == member.name
                       ? "is a struct"
                       : reason_of_member(member.members, path.substr(member.name.size() + 1), kind);
        const auto type = glsl_type(member.type);
        if (type && type->scalar == Scalar::float16) return "is of 16-bit floats";
        if (kind == Constraint::Kind::orthonormal || kind == Constraint::Kind::inverse_transpose)
            if (!type || type->rows != type->columns || type->rows < 2) return "is no square matrix";
    }
    return "";
}

/// Why no check() sees a constraint; empty where the header has nothing of what it names.
std::string reason_unchecked(const Constraint& constraint, const Interface& interface) {
    for (const std::string& name : constraint.names) {
        const std::string path = without_indices(name);
        const auto part = component_name(path);
        const auto is_named = [&](const auto& entry) {
            const std::string own = without_indices(entry.name);
            return own == path || (part && own == part->of) || path.starts_with(own + ".");
        };
        const auto reason = [&]() -> std::string_view {
            if (name.empty()) return "";
            if (std::ranges::any_of(interface.inputs, is_named)) return "is of each vertex";
            if (std::ranges::any_of(interface.uniforms, is_named)) return "is a uniform outside blocks";
            if (std::ranges::any_of(interface.samplers, is_named)) return "is a texture";
            for (const auto* blocks :
                 {&interface.blocks, &interface.storage_blocks, &interface.push_constants})
                for (const Block& block : *blocks)
                    if (is_named(block))
                        return reason_of_member(block.members,
                                                path.substr(without_indices(block.name).size() + 1),
                                                constraint.kind);
            return path.find('.') == std::string::npos ? "is between stages" : "";
        }();
        if (!reason.empty()) return fmt::format("{} {}", name, reason);
    }
    return "";
}

/// What tells of a value that stands in no block whether it keeps the constraint; empty where C++ has it.
std::string_view teller_of(Constraint::Kind kind) {
    switch (kind) {
        case Constraint::Kind::unit:
            return "; gobo::is_unit() tells";
        case Constraint::Kind::orthonormal:
            return "; gobo::is_orthonormal() tells";
        case Constraint::Kind::inverse_transpose:
            return "; gobo::is_inverse_transpose() tells";
        default:
            return "";
    }
}

}  // namespace

std::string domain_text(const std::vector<Domain>& domains, const std::string& path) {
    std::vector<std::string> parts;
    if (const Domain* const domain = domain_of(domains, path)) parts.push_back(range_text(*domain));
    for (std::size_t i = 0; i < kComponents.size(); ++i)
        if (const Domain* const own = domain_of_component(domains, path, i))
            parts.push_back(fmt::format("{} {}", kComponents[i], range_text(*own)));
    return fmt::format("{}", fmt::join(parts, "; "));
}

Result<void> check_section(const std::vector<CppBlock>& blocks, const Interface& interface,
                           const std::vector<Domain>& domains, const HeaderTemplates& templates,
                           TemplateValues& values) {
    const std::vector<Constraint> constraints = constraints_of(domains);
    std::set<std::string> checked;
    std::string& checks = values["checks"] = "";
    const auto add = [&](const std::string& description, const std::string& parameters,
                         const std::string& calls) -> Result<void> {
        GOBO_TRY(
            const std::string text,
            fill(templates.at("check"),
                 {{"description", cpp_comment(description)}, {"parameters", parameters}, {"checks", calls}}));
        checks += text;
        return {};
    };
    for (const CppBlock& block : blocks) {
        std::string calls;
        for (const CppMember& member : block.members)
            calls += member_checks(member, {block.name, "block", {}}, domains,
                                   member.member.name == block.counted ? "count" : "");
        for (const Constraint& constraint : constraints)
            if (const auto call = constraint_call(constraint, block, block)) {
                calls += call->text;
                checked.insert(constraint.text);
            }
        const int extent = counted_extent(block);
        GOBO_TRY_DO(
            add(fmt::format(
                    "What of the block {} lies outside its ranges{}", block.name,
                    extent > 0 ? fmt::format(", as far as the first `count` of `{}`", block.counted) : ""),
                fmt::format("{}const {}& block{}", calls.empty() ? "[[maybe_unused]] " : "", block.type,
                            extent > 0 ? fmt::format(", [[maybe_unused]] int count = {}", extent) : ""),
                calls));
    }
    for (auto block = blocks.begin(); block != blocks.end(); ++block)
        for (auto other = block + 1; other != blocks.end(); ++other) {
            std::string calls;
            bool is_counted = false;
            for (const Constraint& constraint : constraints)
                if (const auto call = block->name == other->name
                                          ? std::nullopt
                                          : constraint_call(constraint, *block, *other)) {
                    calls += call->text;
                    is_counted |= call->is_counted;
                    checked.insert(constraint.text);
                }
            if (calls.empty()) continue;
            const int extent = std::max(counted_extent(*block), counted_extent(*other));
            GOBO_TRY_DO(
                add(fmt::format("What of the blocks {} and {} breaks what must hold between both{}",
                                block->name, other->name,
                                is_counted ? ", as far as the first `count` elements of an array" : ""),
                    fmt::format("const {}& block, const {}& other{}", block->type, other->type,
                                is_counted ? fmt::format(", int count = {}", extent) : ""),
                    calls));
        }
    std::string& unchecked = values["unchecked"] = "";
    for (const Constraint& constraint : constraints)
        if (const std::string reason =
                checked.contains(constraint.text) ? "" : reason_unchecked(constraint, interface);
            !reason.empty())
            unchecked += fmt::format("//     {}: {}{}\n", cpp_comment(constraint.text), cpp_comment(reason),
                                     teller_of(constraint.kind));
    if (!unchecked.empty())
        unchecked = "// Constraints of the family that no check() looks at:\n" + unchecked + "\n";
    return {};
}

}  // namespace gobo
