#include "reflect/interface_format.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

template <class Entry>
constexpr const char* kPlaceName =
    std::is_same_v<Entry, Block> || std::is_same_v<Entry, Sampler> ? "binding" : "location";

template <class Entry>
Json array_of(const std::vector<Entry>& entries);

Json json_of(const Member& member) {
    return {{"name", member.name},
            {"type", member.type},
            {"offset", member.offset},
            {"array", member.array},
            {"array_stride", member.array_stride},
            {"matrix_stride", member.matrix_stride},
            {"row_major", member.row_major},
            {"members", array_of(member.members)}};
}

Json json_of(const Block& block) {
    Json json = {{"name", block.name},
                 {"binding", block.binding},
                 {"size", block.size},
                 {"stages", block.stages},
                 {"members", array_of(block.members)}};
    if (block.set >= 0) json["set"] = block.set;
    if (block.usage.unused) json["unused"] = true;
    return json;
}

Json json_of(const SpecializationConstant& constant) {
    return {{"name", constant.name}, {"type", constant.type}, {"id", constant.id}, {"value", constant.value}};
}

/// A uniform, sampler, input or output.
template <class Entry>
Json json_of(const Entry& entry) {
    Json json = {{"name", entry.name}, {"type", entry.type}, {kPlaceName<Entry>, place_of(entry)}};
    if (!std::is_same_v<Entry, Variable> || !entry.array.empty()) json["array"] = entry.array;
    if constexpr (std::is_same_v<Entry, Uniform>) json["members"] = array_of(entry.members);
    if constexpr (std::is_same_v<Entry, Sampler>)
        if (entry.set >= 0) json["set"] = entry.set;
    if constexpr (std::is_same_v<Entry, Variable>) {
        if (entry.per_vertex) json["per_vertex"] = true;
        if (entry.patch) json["patch"] = true;
    }
    if (entry.usage.unused) json["unused"] = true;
    return json;
}

/// The entries as an array of objects; an empty array where there are none.
template <class Entry>
Json array_of(const std::vector<Entry>& entries) {
    Json array = Json::array();
    for (const Entry& entry : entries) array.push_back(json_of(entry));
    return array;
}

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
        for (std::size_t i = 0; i < row.size(); ++i)
            if (widths[i] > 0) line += fmt::format("{:<{}}  ", row[i], widths[i]);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

/// "binding 3", or empty where the number is unknown.
template <class Entry>
std::string stated_place(const Entry& entry) {
    if (place_of(entry) < 0) return {};
    std::string set;
    if constexpr (requires { entry.set; })
        if (entry.set >= 0) set = fmt::format("set {}, ", entry.set);
    return fmt::format("{}{} {}", set, kPlaceName<Entry>, place_of(entry));
}

std::string strides(const Member& member) {
    std::vector<std::string> parts;
    if (member.array_stride > 0) parts.push_back(fmt::format("array stride {}", member.array_stride));
    if (member.matrix_stride > 0) parts.push_back(fmt::format("matrix stride {}", member.matrix_stride));
    if (member.row_major) parts.emplace_back("row-major");
    return join(parts, ", ");
}

/// Members below their struct, indented; offsets count from the start of what contains them.
void add_members(std::vector<Row>& rows, const std::vector<Member>& members, std::size_t depth,
                 bool with_offsets) {
    const std::string indent(2 * depth, ' ');
    for (const Member& member : members) {
        Row row{indent + member.type, indent + with_extents(member.name, member.array)};
        if (with_offsets) {
            row.insert(row.begin(), fmt::format("{}{:>5}", indent, member.offset));
            row.push_back(strides(member));
        }
        rows.push_back(std::move(row));
        add_members(rows, member.members, depth + 1, with_offsets);
    }
}

std::string blocks_text(std::string_view kind, const std::vector<Block>& blocks) {
    std::vector<std::string> texts;
    for (const Block& block : blocks) {
        std::vector<std::string> facts = {stated_place(block), fmt::format("{} bytes", block.size),
                                          join(block.stages, ", "), block.usage.unused ? "unused" : ""};
        std::erase(facts, "");
        std::vector<Row> rows;
        add_members(rows, block.members, 0, true);
        texts.push_back(fmt::format("{} {}: {}\n{}", kind, block.name, join(facts, ", "), table(rows)));
    }
    return join(texts, "\n");
}

/// Uniforms, samplers, inputs or outputs; empty where there are none.
template <class Entry>
std::string entries_text(std::string_view kind, const std::vector<Entry>& entries) {
    std::vector<Row> rows;
    for (const Entry& entry : entries) {
        Row row{entry.type, with_extents(entry.name, entry.array), stated_place(entry)};
        if constexpr (std::is_same_v<Entry, Variable>) {
            if (entry.per_vertex) row[1] = with_extents(entry.name + "[]", entry.array);
            if (entry.patch) row[0].insert(0, "patch ");
        }
        if constexpr (requires { entry.stages; }) row.push_back(join(entry.stages, ", "));
        if (entry.usage.unused) row.emplace_back("unused");
        rows.push_back(std::move(row));
        if constexpr (requires { entry.members; }) add_members(rows, entry.members, 1, false);
    }
    return rows.empty() ? std::string() : fmt::format("{}:\n{}", kind, table(rows));
}

std::string constants_text(const std::vector<SpecializationConstant>& constants) {
    std::vector<Row> rows;
    for (const SpecializationConstant& constant : constants)
        rows.push_back({constant.type, constant.name, fmt::format("constant_id {}", constant.id)});
    return rows.empty() ? std::string() : fmt::format("specialisation constants:\n{}", table(rows));
}

}  // namespace

Json to_json(const Interface& interface) {
    Json json = {{"stages", interface.stages}, {"blocks", array_of(interface.blocks)}};
    if (!interface.storage_blocks.empty()) json["storage_blocks"] = array_of(interface.storage_blocks);
    json["uniforms"] = array_of(interface.uniforms);
    json["samplers"] = array_of(interface.samplers);
    json["inputs"] = array_of(interface.inputs);
    json["outputs"] = array_of(interface.outputs);
    if (!interface.push_constants.empty()) json["push_constants"] = array_of(interface.push_constants);
    if (!interface.specialization_constants.empty())
        json["specialization_constants"] = array_of(interface.specialization_constants);
    return json;
}

std::string to_text(const Interface& interface) {
    std::vector<std::string> sections = {fmt::format("stages: {}\n", join(interface.stages, ", ")),
                                         blocks_text("block", interface.blocks),
                                         blocks_text("storage block", interface.storage_blocks),
                                         entries_text("uniforms", interface.uniforms),
                                         entries_text("samplers", interface.samplers),
                                         entries_text("inputs", interface.inputs),
                                         entries_text("outputs", interface.outputs),
                                         blocks_text("push constants", interface.push_constants),
                                         constants_text(interface.specialization_constants)};
    std::erase(sections, "");
    return join(sections, "\n");
}

}  // namespace gobo
