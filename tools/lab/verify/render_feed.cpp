#include "lab/verify/render_feed.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lab/evaluate/images.hpp"
#include "lab/render/mesh.hpp"

namespace gobo::verify {
namespace {

bool has_port(const std::vector<evaluate::Port>& ports, const std::string& name) {
    return std::any_of(ports.begin(), ports.end(),
                       [&](const evaluate::Port& port) { return port.name == name; });
}

/// A plain uniform's elements under their own names.
void add_plain_uniform(const evaluate::Program& program, const Assignment& assignment,
                       evaluate::Invocations& invocations) {
    const auto type = glsl_type(assignment.leaf.type);
    if (!type) return;
    const auto components = static_cast<std::size_t>(type->components());
    const std::string& name = assignment.leaf.name;
    for (std::size_t i = 0; (i + 1) * components <= assignment.numbers.size(); ++i) {
        const std::string element = assignment.leaf.is_array && !has_port(program.uniforms, name)
                                        ? fmt::format("{}[{}]", name, i)
                                        : name;
        if (!has_port(program.uniforms, element)) continue;
        const double* first = assignment.numbers.data() + i * components;
        invocations.values[element] = std::vector<double>(first, first + components);
    }
}

/// What a texture of one colour answers: the comparison, its size, or the colour.
evaluate::Image plain_image(const std::array<double, 4>& color, bool is_depth) {
    return [color, is_depth](const evaluate::ImageRequest& request) {
        return evaluate::answer(color, request, is_depth ? 1 : 64);
    };
}

void add_images(const evaluate::Program& program, const std::vector<RenderValue>& values,
                evaluate::Invocations& invocations) {
    for (const evaluate::ImagePort& port : program.images) {
        const RenderValue* value = find_value(values, port.name.substr(0, port.name.find('[')));
        std::array<double, 4> color = {0, 0, 0, 1};
        if (value != nullptr)
            std::copy_n(value->numbers.begin(), std::min<std::size_t>(value->numbers.size(), 4),
                        color.begin());
        invocations.images[port.name] = plain_image(color, port.type.depth);
    }
}

/// Component by component, all vertices of each.
std::vector<double> by_component(const AttributeValues& values, std::uint32_t components) {
    if (!values.integers.empty()) return {values.integers.begin(), values.integers.end()};
    const auto own = static_cast<std::size_t>(values.components);
    const std::size_t count = values.floats.size() / own;
    std::vector<double> numbers(components * count, 0);
    for (std::size_t c = 0; c < components; ++c)
        for (std::size_t i = 0; i < count; ++i)
            // What an attribute lacks is 0, and its fourth component 1 (OpenGL 4.5, 10.2).
            numbers[c * count + i] = c < own ? values.floats[i * own + c] : (c == 3 ? 1.0 : 0.0);
    return numbers;
}

}  // namespace

std::vector<RenderValue> with_plain_textures(const Interface& interface, std::vector<RenderValue> values) {
    for (const Sampler& sampler : interface.samplers) {
        const RenderValue* given = find_value(values, sampler.name);
        if (given != nullptr && !given->numbers.empty()) continue;
        const bool is_depth = sampler.type.find("Shadow") != std::string::npos;
        RenderValue plain;
        plain.name = sampler.name;
        plain.numbers = is_depth ? std::vector<double>{1} : std::vector<double>{0.25, 0.5, 0.75, 1};
        values.push_back(std::move(plain));
    }
    return values;
}

Result<evaluate::Invocations> uniforms_of(const evaluate::Program& program, const Interface& interface,
                                          const std::vector<RenderValue>& values, const ViewedObject& view) {
    const auto resolved = resolve_uniforms(interface, values, view);
    if (!resolved) return tl::unexpected(resolved.error());
    evaluate::Invocations invocations;
    for (const Block& block : interface.blocks) {
        const bool is_read = std::any_of(program.uniform_blocks.begin(), program.uniform_blocks.end(),
                                         [&](const auto& own) { return own.name == block.name; });
        if (!is_read) continue;
        invocations.blocks[block.name] = bytes_of(block, resolved->assignments);
    }
    for (const Assignment& assignment : resolved->assignments)
        if (assignment.leaf.block.empty()) add_plain_uniform(program, assignment, invocations);
    add_images(program, values, invocations);
    return invocations;
}

void add_attributes(const evaluate::Program& program, const Mesh& mesh,
                    const std::vector<RenderValue>& values, evaluate::Invocations& invocations) {
    invocations.count = mesh.positions.size();
    for (const evaluate::Port& port : program.inputs) {
        if (port.name.starts_with("gl_")) continue;  // gl_InstanceID and the like are 0
        const RenderValue* value = find_value(values, port.name);
        const std::string source(value != nullptr ? value->source : attribute_source_of(port.name));
        std::vector<double>& numbers = invocations.values[port.name];
        if (value != nullptr && source.empty()) {
            numbers = value->numbers;
            while (numbers.size() < port.components) numbers.push_back(numbers.size() == 3 ? 1 : 0);
        } else if (const auto own = attribute_values(mesh, source)) {
            numbers = by_component(*own, port.components);
        } else {
            numbers.assign(port.components, source == "color" ? 1 : 0);
        }
    }
}

}  // namespace gobo::verify
