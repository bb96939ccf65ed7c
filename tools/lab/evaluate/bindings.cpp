#include "lab/evaluate/bindings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::evaluate {
namespace {

std::vector<std::string> known_names(const Program& program) {
    std::vector<std::string> names;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const Port& port : *ports) names.push_back(port.name);
    return names;
}

const Port* find_port(const Program& program, std::string_view name) {
    for (const auto* ports : {&program.inputs, &program.uniforms}) {
        const auto found =
            std::lower_bound(ports->begin(), ports->end(), name,
                             [](const Port& port, std::string_view wanted) { return port.name < wanted; });
        if (found != ports->end() && found->name == name) return &*found;
    }
    return nullptr;
}

double read_scalar(Scalar scalar, const std::byte* bytes) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes, sizeof bits);
    if (scalar == Scalar::signed_integer) return static_cast<std::int32_t>(bits);
    if (scalar != Scalar::real) return bits;
    float real = 0;
    std::memcpy(&real, &bits, sizeof real);
    return static_cast<double>(real);
}

/// Members that lie beyond the end of the bytes stay 0: a buffer for fewer array elements is enough.
void bind_block(const Program& program, std::size_t block, const std::vector<std::byte>& bytes,
                std::vector<Binding>& bindings) {
    for (const Port& port : program.uniforms) {
        if (port.block != static_cast<int>(block)) continue;
        Binding binding{&port, {}, false};
        for (const std::uint32_t offset : port.offsets) {
            const bool is_inside = std::size_t{offset} + 4 <= bytes.size();
            binding.values.push_back(is_inside ? read_scalar(port.scalar, bytes.data() + offset) : 0.0);
        }
        bindings.push_back(std::move(binding));
    }
}

}  // namespace

Result<std::vector<Binding>> bind(const Program& program, const Invocations& invocations) {
    std::vector<Binding> bindings;
    for (const auto& [name, bytes] : invocations.blocks) {
        const auto& blocks = program.uniform_blocks;
        const auto found = std::find_if(blocks.begin(), blocks.end(),
                                        [&](const UniformBlock& block) { return block.name == name; });
        if (found == blocks.end()) {
            std::vector<std::string> names;
            for (const UniformBlock& block : blocks) names.push_back(block.name);
            return fail(Fault::input, fmt::format("the stage has no uniform block '{}'", name),
                        suggestion(name, names));
        }
        bind_block(program, static_cast<std::size_t>(found - blocks.begin()), bytes, bindings);
    }
    for (const auto& [name, values] : invocations.values) {
        const Port* port = find_port(program, name);
        if (port == nullptr)
            return fail(Fault::input, fmt::format("the stage has no input or uniform '{}'", name),
                        suggestion(name, known_names(program)));
        const std::size_t for_each = port->components * invocations.count;
        if (values.size() != port->components && values.size() != for_each)
            return fail(
                Fault::input,
                fmt::format("'{}' is a {}: it takes {} numbers, or {} for {} invocations, not {}", name,
                            port->type, port->components, for_each, invocations.count, values.size()));
        bindings.push_back({port, values, values.size() == for_each && invocations.count > 1});
    }
    return bindings;
}

double shortest_decimal(float value) {
    if (!std::isfinite(value)) return static_cast<double>(value);
    std::array<char, 64> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
    double decimal = 0;
    std::from_chars(text.data(), written.ptr, decimal);
    return decimal;
}

}  // namespace gobo::evaluate
