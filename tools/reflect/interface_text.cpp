#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "reflect/interface_format.hpp"

namespace gobo {
namespace {

using Row = std::vector<std::string>;

/// Rows of cells with every column as wide as its widest cell; columns without any text take no room.
std::string table(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths;
    for (const Row& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const Row& row : rows) {
        std::string line = "  ";
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (widths[i] > 0) line += fmt::format("{:<{}}  ", row[i], widths[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

std::string extents(const std::vector<int>& array) {
    std::string text;
    for (const int extent : array) text += extent == 0 ? "[]" : fmt::format("[{}]", extent);
    return text;
}

/// "binding 3", or empty where the number is unknown.
std::string place(std::string_view kind, int number) {
    return number < 0 ? std::string() : fmt::format("{} {}", kind, number);
}

std::string strides(const Member& member) {
    std::vector<std::string> parts;
    if (member.array_stride > 0) parts.push_back(fmt::format("array stride {}", member.array_stride));
    if (member.matrix_stride > 0) parts.push_back(fmt::format("matrix stride {}", member.matrix_stride));
    if (member.row_major) parts.emplace_back("row-major");
    return join(parts, ", ");
}

/// Members below their struct, indented; offsets count from the start of what contains them.
void add_members(std::vector<Row>& rows, const std::vector<Member>& members, int depth, bool with_offsets) {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    for (const Member& member : members) {
        const std::string offset = with_offsets ? fmt::format("{}{:>5}", indent, member.offset) : indent;
        rows.push_back(
            {offset, indent + member.type, indent + member.name + extents(member.array), strides(member)});
        add_members(rows, member.members, depth + 1, with_offsets);
    }
}

std::string block_text(const Block& block, std::string_view kind) {
    std::vector<std::string> facts = {fmt::format("{} bytes", block.size), join(block.stages, ", ")};
    if (block.binding >= 0) facts.insert(facts.begin(), place("binding", block.binding));
    std::vector<Row> rows;
    add_members(rows, block.members, 0, true);
    return fmt::format("{} {}: {}\n{}", kind, block.name, join(facts, ", "), table(rows));
}

std::string uniforms_text(const std::vector<Uniform>& uniforms) {
    std::vector<Row> rows;
    for (const Uniform& uniform : uniforms) {
        rows.push_back({uniform.type, uniform.name + extents(uniform.array),
                        place("location", uniform.location), join(uniform.stages, ", ")});
        for (const Member& member : uniform.members) {
            std::vector<Row> inner;
            add_members(inner, {member}, 1, false);
            for (const Row& row : inner) rows.push_back({row[1], row[2]});
        }
    }
    return table(rows);
}

std::string samplers_text(const std::vector<Sampler>& samplers) {
    std::vector<Row> rows;
    for (const Sampler& sampler : samplers) {
        rows.push_back({sampler.type, sampler.name + extents(sampler.array),
                        place("binding", sampler.binding), join(sampler.stages, ", ")});
    }
    return table(rows);
}

std::string variables_text(const std::vector<Variable>& variables) {
    std::vector<Row> rows;
    for (const Variable& variable : variables) {
        rows.push_back(
            {variable.type, variable.name + extents(variable.array), place("location", variable.location)});
    }
    return table(rows);
}

}  // namespace

std::string to_text(const Interface& interface) {
    std::vector<std::string> sections = {fmt::format("stages: {}\n", join(interface.stages, ", "))};
    for (const Block& block : interface.blocks) sections.push_back(block_text(block, "block"));
    for (const Block& block : interface.storage_blocks)
        sections.push_back(block_text(block, "storage block"));
    if (!interface.uniforms.empty()) sections.push_back("uniforms:\n" + uniforms_text(interface.uniforms));
    if (!interface.samplers.empty()) sections.push_back("samplers:\n" + samplers_text(interface.samplers));
    if (!interface.inputs.empty()) sections.push_back("inputs:\n" + variables_text(interface.inputs));
    if (!interface.outputs.empty()) sections.push_back("outputs:\n" + variables_text(interface.outputs));
    return join(sections, "\n");
}

}  // namespace gobo
