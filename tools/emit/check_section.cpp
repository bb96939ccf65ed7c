#include "emit/check_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/cpp_text.hpp"

namespace gobo {
namespace {

/// Where a member stands: for messages, in C++, and within which loops.
struct Spot {
    std::string path;        ///< "PointLights.lights[].color"
    std::string expression;  ///< "block.lights[i0].color"
    std::vector<std::string> indices;
};

std::string indent_of(const Spot& spot) {
    return std::string(4 * (spot.indices.size() + 1), ' ');
}

/// A call for the member's numbers; nothing where the family declares no range for them.
std::string number_check(const Spot& spot, const std::vector<Domain>& domains) {
    const Domain* domain = domain_of(domains, spot.path);
    if (domain == nullptr) return {};
    std::string text = domain_text(domains, spot.path);
    const std::string length = "length in ";
    if (text.starts_with(length)) text = "a length in " + text.substr(length.size());
    return fmt::format(
        "{0}gobo::runtime::check_member(found, {1}, {{{2}}}, {3},\n{0}                            "
        "{{{4}, {5}, {6}, {{{7}}}, {8}}});\n",
        indent_of(spot), cpp_literal(spot.path), fmt::join(spot.indices, ", "), spot.expression, domain->low,
        domain->high, domain->of_length, fmt::join(domain->also, ", "), cpp_literal(text));
}

/// The checks of a member, within a loop for each extent of its array; `count` is the outermost loop's bound
/// where it is given.
std::string member_checks(const NamedMember& named, const Spot& parent, const std::vector<Domain>& domains,
                          const std::string& count) {
    Spot spot{parent.path + "." + named.member.name, parent.expression + "." + named.identifier,
              parent.indices};
    std::string head;
    std::string tail;
    for (std::size_t extent = 0; extent < named.member.array.size(); ++extent) {
        const std::string index = fmt::format("i{}", spot.indices.size());
        const std::string bound =
            extent == 0 && !count.empty() ? count : std::to_string(named.member.array[extent]);
        head += fmt::format("{0}for (int {1} = 0; {1} < {2}; ++{1}) {{\n", indent_of(spot), index, bound);
        tail = indent_of(spot) + "}\n" + tail;
        spot.path += "[]";
        spot.expression += "[" + index + "]";
        spot.indices.push_back(index);
    }
    std::string body = named.members.empty() ? number_check(spot, domains) : "";
    for (const NamedMember& part : named.members) body += member_checks(part, spot, domains, "");
    return body.empty() ? body : head + body + tail;
}

std::string block_check(const NamedBlock& block, const std::vector<Domain>& domains) {
    const bool ends_in_array = !block.members.empty() && !block.members.back().member.array.empty();
    const int extent = ends_in_array ? block.members.back().member.array.front() : 0;
    std::string body;
    for (const NamedMember& named : block.members) {
        const bool is_counted = ends_in_array && &named == &block.members.back();
        body += member_checks(named, {block.glsl_name, "block", {}}, domains, is_counted ? "count" : "");
    }
    const bool uses_block = !body.empty();
    return fmt::format(
        "/// What of the block {} lies outside its ranges{}; empty where nothing does.\n"
        "[[nodiscard]] inline std::vector<gobo::OutOfRange> check({}const {}& block{}) {{\n"
        "    std::vector<gobo::OutOfRange> found;\n"
        "{}"
        "    return found;\n"
        "}}\n\n",
        block.glsl_name,
        ends_in_array ? fmt::format(", as far as the first `count` of `{}`", block.members.back().member.name)
                      : "",
        uses_block ? "" : "[[maybe_unused]] ", block.cpp_name,
        ends_in_array ? fmt::format(", [[maybe_unused]] int count = {}", extent) : "", body);
}

}  // namespace

std::string check_section(const std::vector<NamedBlock>& blocks, const std::vector<Domain>& domains) {
    std::string text;
    for (const NamedBlock& block : blocks) text += block_check(block, domains);
    return text;
}

}  // namespace gobo
