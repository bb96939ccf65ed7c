#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "emit/sections.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// Gives every item without a place the lowest free one. `size` says how many places an item takes.
template <class Item, class SizeOf>
void fill_places(std::vector<Item>& items, SizeOf size) {
    std::set<int> taken;
    const auto take = [&](const Item& item) {
        for (int used = 0; used < size(item); ++used) taken.insert(place_of(item) + used);
    };
    for (const Item& item : items)
        if (place_of(item) >= 0) take(item);
    for (Item& item : items) {
        if (place_of(item) >= 0) continue;
        int first = 0;
        for (int used = 0; used < size(item);) {
            const bool free = !taken.contains(first + used);
            used = free ? used + 1 : 0;
            if (!free) ++first;
        }
        place_of(item) = first;
        take(item);
    }
}

/// A constant for each variable or sampler: where it is.
template <class Item>
std::string constants_of(const std::vector<Item>& items, const std::vector<Domain>& domains) {
    CppScope scope;
    std::string text;
    for (const Item& item : items) {
        const std::string domain = domain_text(domains, item.name);
        text += fmt::format("inline constexpr int {} = {};  ///< {}{}{}\n",
                            scope.claim(cpp_identifier(item.name)), place_of(item), cpp_comment(item.type),
                            domain.empty() ? "" : ", ", domain);
    }
    return text;
}

/// Name, type, place and, where each element takes a place, how many: as the header's tables have them.
template <class Item>
std::string row_of(const Item& item) {
    std::string row = "{" + cpp_literal(item.name);
    if constexpr (requires { item.type; }) row += ", " + cpp_literal(item.type);
    row += fmt::format(", {}", place_of(item));
    if constexpr (std::is_same_v<Item, Sampler>) row += fmt::format(", {}", element_count(item.array));
    return row + "}";
}

/// A row for each name that OpenGL knows: members of structs, and elements of arrays of structs or arrays,
/// are uniforms of their own, at locations that follow one another where the first is stated.
void add_uniform_rows(const Uniform& uniform, int& location, std::vector<std::string>& rows) {
    Uniform part = uniform;
    const bool is_plain_array = uniform.members.empty() && uniform.array.size() == 1;
    if (!uniform.array.empty() && !is_plain_array) {
        part.array.erase(part.array.begin());
        for (int index = 0; index < uniform.array.front(); ++index) {
            part.name = fmt::format("{}[{}]", uniform.name, index);
            add_uniform_rows(part, location, rows);
        }
        return;
    }
    for (const Member& member : uniform.members)
        add_uniform_rows(
            {uniform.name + "." + member.name, member.type, -1, member.array, member.members, {}}, location,
            rows);
    if (!uniform.members.empty()) return;
    const int count = element_count(uniform.array);
    rows.push_back(fmt::format("{{{}, {}, {}, {}}}", cpp_literal(uniform.name), cpp_literal(uniform.type),
                               location, count));
    if (location >= 0) location += count;
}

}  // namespace

Interface with_places(Interface interface) {
    const auto is_built_in = [](const Variable& variable) { return variable.name.starts_with("gl_"); };
    std::erase_if(interface.inputs, is_built_in);
    std::erase_if(interface.outputs, is_built_in);
    fill_places(interface.blocks, [](const Block&) { return 1; });
    fill_places(interface.samplers, [](const Sampler& sampler) { return element_count(sampler.array); });
    fill_places(interface.inputs,
                [](const Variable& input) { return location_count(input.type, input.array); });
    if (interface.outputs.size() == 1 && interface.outputs.front().location < 0)
        interface.outputs.front().location = 0;
    return interface;
}

void interface_section(const Interface& interface, const std::vector<Domain>& domains,
                       TemplateValues& values) {
    values["attribute_constants"] = constants_of(interface.inputs, domains);
    values["output_constants"] = constants_of(interface.outputs, domains);
    values["sampler_constants"] = constants_of(interface.samplers, {});
    const auto add_rows = [&](const std::string& name, const auto& items) {
        std::vector<std::string> rows;
        for (const auto& item : items) rows.push_back(row_of(item));
        add_table(values, name, rows);
    };
    add_rows("attribute", interface.inputs);
    add_rows("output", interface.outputs);
    add_rows("block", interface.blocks);
    add_rows("sampler", interface.samplers);
    std::vector<std::string> uniforms;
    for (const Uniform& uniform : interface.uniforms) {
        int location = uniform.location;
        add_uniform_rows(uniform, location, uniforms);
    }
    add_table(values, "uniform", uniforms);
}

}  // namespace gobo
