#include "emit/interface_section.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "emit/cpp_text.hpp"
#include "emit/identifiers.hpp"
#include "emit/struct_section.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// Gives every item without a place the lowest free one. `place` refers to an item's place, `size` says how
/// many it takes.
template <class Items, class PlaceOf, class SizeOf>
void fill_places(Items& items, PlaceOf place, SizeOf size) {
    std::set<int> taken;
    for (auto& item : items) {
        if (place(item) < 0) continue;
        for (int used = 0; used < size(item); ++used) taken.insert(place(item) + used);
    }
    for (auto& item : items) {
        if (place(item) >= 0) continue;
        int first = 0;
        for (int used = 0; used < size(item);) {
            const bool free = !taken.contains(first + used);
            used = free ? used + 1 : 0;
            if (!free) ++first;
        }
        place(item) = first;
        for (int used = 0; used < size(item); ++used) taken.insert(first + used);
    }
}

void leave_out_built_in(std::vector<Variable>& variables) {
    std::erase_if(variables, [](const Variable& variable) { return variable.name.starts_with("gl_"); });
}

std::string constants_of(const std::vector<Variable>& variables, const std::vector<Domain>& domains) {
    CppScope scope;
    std::string text;
    for (const Variable& variable : variables) {
        const std::string domain = domain_text(domains, variable.name);
        text += fmt::format("inline constexpr int {} = {};  ///< {}{}\n",
                            scope.claim(cpp_identifier(variable.name)), variable.location, variable.type,
                            domain.empty() ? domain : ", " + domain);
    }
    return text;
}

std::string constants_of(const std::vector<Sampler>& samplers) {
    CppScope scope;
    std::string text;
    for (const Sampler& sampler : samplers) {
        text += fmt::format("inline constexpr int {} = {};  ///< {}\n",
                            scope.claim(cpp_identifier(sampler.name)), sampler.binding, sampler.type);
    }
    return text;
}

void add_table(TemplateValues& values, const std::string& name, const std::vector<std::string>& rows) {
    values[name + "_count"] = std::to_string(rows.size());
    values[name + "s"] = cpp_list(rows);
}

/// A uniform outside any block, or a part of one.
struct UniformPart {
    std::string name;
    std::string type;
    std::vector<int> array;
    std::vector<Member> members;
};

/// A row for each name that OpenGL knows: members of structs, and elements of arrays of structs or arrays,
/// are uniforms of their own, at locations that follow one another where the first is stated.
void add_uniform_rows(const UniformPart& part, int& location, std::vector<std::string>& rows) {
    const bool is_plain_array = part.members.empty() && part.array.size() == 1;
    if (!part.array.empty() && !is_plain_array) {
        const std::vector<int> inner(part.array.begin() + 1, part.array.end());
        for (int index = 0; index < part.array.front(); ++index) {
            add_uniform_rows({fmt::format("{}[{}]", part.name, index), part.type, inner, part.members},
                             location, rows);
        }
        return;
    }
    for (const Member& member : part.members) {
        add_uniform_rows({part.name + "." + member.name, member.type, member.array, member.members}, location,
                         rows);
    }
    if (!part.members.empty()) return;
    const int count = element_count(part.array);
    rows.push_back(
        fmt::format("{{{}, {}, {}, {}}}", cpp_literal(part.name), cpp_literal(part.type), location, count));
    if (location >= 0) location += count;
}

void add_variables(TemplateValues& values, const std::string& name, const std::vector<Variable>& variables) {
    std::vector<std::string> rows;
    for (const Variable& variable : variables) {
        rows.push_back(fmt::format("{{{}, {}, {}}}", cpp_literal(variable.name), cpp_literal(variable.type),
                                   variable.location));
    }
    add_table(values, name, rows);
}

}  // namespace

Interface with_places(Interface interface) {
    leave_out_built_in(interface.inputs);
    leave_out_built_in(interface.outputs);
    fill_places(
        interface.blocks, [](Block& block) -> int& { return block.binding; }, [](const Block&) { return 1; });
    fill_places(
        interface.samplers, [](Sampler& sampler) -> int& { return sampler.binding; },
        [](const Sampler& sampler) { return element_count(sampler.array); });
    fill_places(
        interface.inputs, [](Variable& input) -> int& { return input.location; },
        [](const Variable& input) { return location_count(input.type, input.array); });
    if (interface.outputs.size() == 1 && interface.outputs.front().location < 0) {
        interface.outputs.front().location = 0;
    }
    return interface;
}

void describe_interface(const Interface& interface, const std::vector<Domain>& domains,
                        TemplateValues& values) {
    values["attribute_constants"] = constants_of(interface.inputs, domains);
    values["output_constants"] = constants_of(interface.outputs, domains);
    values["sampler_constants"] = constants_of(interface.samplers);
    std::vector<std::string> blocks;
    for (const Block& block : interface.blocks) {
        blocks.push_back(fmt::format("{{{}, {}}}", cpp_literal(block.name), block.binding));
    }
    std::vector<std::string> samplers;
    for (const Sampler& sampler : interface.samplers) {
        samplers.push_back(fmt::format("{{{}, {}, {}, {}}}", cpp_literal(sampler.name),
                                       cpp_literal(sampler.type), sampler.binding,
                                       element_count(sampler.array)));
    }
    std::vector<std::string> uniforms;
    for (const Uniform& uniform : interface.uniforms) {
        int location = uniform.location;
        add_uniform_rows({uniform.name, uniform.type, uniform.array, uniform.members}, location, uniforms);
    }
    add_table(values, "block", blocks);
    add_table(values, "sampler", samplers);
    add_table(values, "uniform", uniforms);
    add_variables(values, "attribute", interface.inputs);
    add_variables(values, "output", interface.outputs);
}

}  // namespace gobo
