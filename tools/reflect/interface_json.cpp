#include <nlohmann/json.hpp>

#include "reflect/interface_format.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Member& member);
Json json_of(const Block& block);
Json json_of(const Uniform& uniform);
Json json_of(const Sampler& sampler);
Json json_of(const Variable& variable);

/// The entries as an array of objects; an empty array where there are none.
template <class Entry>
Json array_of(const std::vector<Entry>& entries) {
    Json array = Json::array();
    for (const Entry& entry : entries) array.push_back(json_of(entry));
    return array;
}

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
    return {{"name", block.name},
            {"binding", block.binding},
            {"size", block.size},
            {"stages", block.stages},
            {"members", array_of(block.members)}};
}

Json json_of(const Uniform& uniform) {
    return {{"name", uniform.name},
            {"type", uniform.type},
            {"location", uniform.location},
            {"array", uniform.array},
            {"members", array_of(uniform.members)}};
}

Json json_of(const Sampler& sampler) {
    return {{"name", sampler.name},
            {"type", sampler.type},
            {"binding", sampler.binding},
            {"array", sampler.array}};
}

Json json_of(const Variable& variable) {
    Json json = {{"name", variable.name}, {"type", variable.type}, {"location", variable.location}};
    if (!variable.array.empty()) json["array"] = variable.array;
    return json;
}

}  // namespace

Json to_json(const Interface& interface) {
    Json json = {{"stages", interface.stages}, {"blocks", array_of(interface.blocks)}};
    if (!interface.storage_blocks.empty()) json["storage_blocks"] = array_of(interface.storage_blocks);
    json["uniforms"] = array_of(interface.uniforms);
    json["samplers"] = array_of(interface.samplers);
    json["inputs"] = array_of(interface.inputs);
    json["outputs"] = array_of(interface.outputs);
    return json;
}

}  // namespace gobo
