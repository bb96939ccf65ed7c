#include "lab/cost/pipeline.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "lab/cost/plain_uniforms.hpp"
#include "lab/cost/varying_loops.hpp"
#include "spirv/module.hpp"

namespace gobo::cost {
namespace {

using spirv::Id;
using spirv::Module;
using spirv::Type;
using spirv::Variable;

/// By variable.
using Numbers = std::map<Id, std::uint32_t>;

/// The type without its arrays, and how many elements these have.
std::pair<Id, std::uint32_t> element_of(const Module& module, Id type) {
    std::uint32_t count = 1;
    while (module.type(type).is_array()) {
        count *= std::max(module.type(type).count, 1U);
        type = module.type(type).element;
    }
    return {type, count};
}

bool is_resource(const Variable& variable) {
    return variable.storage == spv::StorageClassUniformConstant ||
           variable.storage == spv::StorageClassUniform || variable.storage == spv::StorageClassStorageBuffer;
}

/// A block's name, or a variable's.
std::string name_of(const Module& module, const Variable& variable) {
    if (variable.storage == spv::StorageClassUniformConstant) return module.name(variable.id);
    return "block " + module.name(element_of(module, variable.type).first);
}

Descriptor descriptor_of(const Module& module, const Variable& variable) {
    using enum Descriptor::Kind;
    const auto [element, count] = element_of(module, variable.type);
    const Type& type = module.type(element);
    if (type.opcode == spv::OpTypeSampler) return Descriptor{sampler, count};
    if (type.is_image()) {
        const bool is_buffer = type.image.dimension == spv::DimBuffer;
        if (type.image.dimension == spv::DimSubpassData) return Descriptor{input_attachment, count};
        if (type.image.storage) return Descriptor{is_buffer ? image_buffer : image, count};
        if (is_buffer) return Descriptor{texel_buffer, count};
        return Descriptor{type.opcode == spv::OpTypeImage ? bare_texture : texture, count};
    }
    const bool is_storage = variable.storage == spv::StorageClassStorageBuffer ||
                            module.decoration(element, spv::DecorationBufferBlock).has_value();
    return Descriptor{is_storage ? storage_buffer : uniform_buffer, count};
}

/// The variables that stages pass on.
std::vector<const Variable*> varyings_of(const Module& module, spv::StorageClass storage) {
    std::vector<const Variable*> varyings;
    for (const Variable& variable : module.variables)
        if (variable.storage == storage && module.decoration(variable.id, spv::DecorationLocation))
            varyings.push_back(&variable);
    return varyings;
}

/// What OpenGL matches a varying by.
std::string varying_name(const Module& module, const Variable& variable) {
    const Id element = element_of(module, variable.type).first;
    const bool is_block = module.decoration(element, spv::DecorationBlock).has_value();
    return is_block ? module.name(element) : module.name(variable.id);
}

std::uint32_t location_of(const Module& module, const Variable& variable) {
    return module.decoration(variable.id, spv::DecorationLocation).value_or(0);
}

std::uint32_t locations_taken(const Module& module, Id id) {
    const Type& type = module.type(id);
    if (type.is_array()) return std::max(type.count, 1U) * locations_taken(module, type.element);
    if (type.opcode == spv::OpTypeStruct) {
        std::uint32_t sum = 0;
        for (const Id member : type.members) sum += locations_taken(module, member);
        return sum;
    }
    const std::uint32_t columns = static_cast<std::uint32_t>(type.value.columns);
    return type.value.column_size() > 16 ? 2 * columns : columns;
}

/// Locations by which each input of the fragment stage meets the output of its name. Empty where they meet
/// already: locations that the source states may share a register.
std::pair<Numbers, Numbers> matched_locations(const Module& vertex, const Module& fragment) {
    const auto outputs = varyings_of(vertex, spv::StorageClassOutput);
    const auto inputs = varyings_of(fragment, spv::StorageClassInput);
    const auto output_of = [&](const Variable& input) -> const Variable* {
        for (const Variable* output : outputs)
            if (varying_name(vertex, *output) == varying_name(fragment, input)) return output;
        for (const Variable* output : outputs)
            if (location_of(vertex, *output) == location_of(fragment, input)) return output;
        return nullptr;
    };
    const bool all_meet = std::all_of(inputs.begin(), inputs.end(), [&](const Variable* input) {
        const Variable* output = output_of(*input);
        return output == nullptr || location_of(vertex, *output) == location_of(fragment, *input);
    });
    std::pair<Numbers, Numbers> locations;
    if (all_meet) return locations;
    std::uint32_t next = 0;
    for (const Variable* output : outputs) {
        locations.first[output->id] = next;
        next += locations_taken(vertex, output->type);
    }
    for (const Variable* input : inputs) {
        const Variable* output = output_of(*input);
        locations.second[input->id] = output != nullptr ? locations.first[output->id] : next;
        if (output == nullptr) next += locations_taken(fragment, input->type);
    }
    return locations;
}

bool declares_type(spv::Op opcode) {
    return opcode >= spv::OpTypeVoid && opcode <= spv::OpTypeForwardPointer;
}

/// The module in Vulkan's words, with those bindings in set 0 and those locations.
Words rewritten(const Module& module, const Words& words, const Numbers& bindings, const Numbers& locations) {
    Words out(words.begin(), words.begin() + 5);
    const auto decorate = [&](Id id, spv::Decoration kind, std::uint32_t value) {
        out.insert(out.end(), {4U << spv::WordCountShift | spv::OpDecorate, static_cast<std::uint32_t>(id),
                               static_cast<std::uint32_t>(kind), value});
    };
    bool has_decorated = false;
    for (const spirv::Instruction& instruction : module.instructions) {
        if (!has_decorated && declares_type(instruction.opcode)) {
            has_decorated = true;
            for (const auto& [id, binding] : bindings) {
                decorate(id, spv::DecorationDescriptorSet, 0);
                decorate(id, spv::DecorationBinding, binding);
            }
            for (const auto& [id, location] : locations) decorate(id, spv::DecorationLocation, location);
        }
        const auto kind = instruction.as<spv::Decoration>(2);
        if (instruction.opcode == spv::OpDecorate) {
            const Id id = instruction.id(1);
            const bool binds = kind == spv::DecorationBinding || kind == spv::DecorationDescriptorSet;
            if (binds && bindings.contains(id)) continue;
            const bool has_place = bindings.contains(id) || locations.contains(id);
            if (kind == spv::DecorationLocation && has_place) continue;
        }
        const std::size_t at = out.size();
        out.insert(out.end(), instruction.words.begin(), instruction.words.end());
        if (instruction.opcode == spv::OpDecorate && kind == spv::DecorationBuiltIn) {
            if (out[at + 3] == spv::BuiltInVertexId) out[at + 3] = spv::BuiltInVertexIndex;
            if (out[at + 3] == spv::BuiltInInstanceId) out[at + 3] = spv::BuiltInInstanceIndex;
        }
        if (instruction.opcode == spv::OpExecutionMode && out[at + 2] == spv::ExecutionModeOriginLowerLeft)
            out[at + 2] = spv::ExecutionModeOriginUpperLeft;
    }
    return out;
}

Result<std::vector<VertexInput>> inputs_of(const Module& module) {
    std::vector<VertexInput> inputs;
    for (const Variable* variable : varyings_of(module, spv::StorageClassInput)) {
        const auto [element, count] = element_of(module, variable->type);
        const GlslType& type = module.type(element).value;
        if (type.scalar != Scalar::float32 && !is_integer(type.scalar))
            return fail({.message = fmt::format(
                             "vertex input {} is a {}: only components of 32 bits can be asked about",
                             module.name(variable->id), type.name()),
                         .help = "declare it with floats for the estimate",
                         .subject = module.name(variable->id)});
        const std::uint32_t columns = count * static_cast<std::uint32_t>(type.columns);
        for (std::uint32_t i = 0; i < columns; ++i)
            inputs.push_back({location_of(module, *variable) + i, type.scalar, type.rows});
    }
    return inputs;
}

std::vector<std::optional<Scalar>> outputs_of(const Module& module) {
    std::vector<std::optional<Scalar>> outputs;
    for (const Variable* variable : varyings_of(module, spv::StorageClassOutput)) {
        const auto [element, count] = element_of(module, variable->type);
        const std::size_t first = location_of(module, *variable);
        outputs.resize(std::max(outputs.size(), first + count));
        for (std::size_t i = 0; i < count; ++i) outputs[first + i] = module.type(element).value.scalar;
    }
    return outputs;
}

/// What tells a resource from others: to OpenGL its name, to Vulkan its place.
std::string identity_of(const Module& module, const Variable& variable, bool is_opengl) {
    const auto at = [&](spv::Decoration kind) { return module.decoration(variable.id, kind).value_or(0); };
    return is_opengl ? name_of(module, variable)
                     : fmt::format("{}.{}", at(spv::DecorationDescriptorSet), at(spv::DecorationBinding));
}

/// OpenGL's stages match by names, and varyings that meet by name get the same locations.
Result<Pipeline> linked(std::vector<PipelineStage> stages, bool is_opengl) {
    Pipeline pipeline;
    std::vector<Module> modules;
    for (PipelineStage& stage : stages) {
        GOBO_TRY(Module module, spirv::read_module(stage.words));
        modules.push_back(std::move(module));
        stage.loop_varies = has_varying_loop(modules.back());
        if (stage.kind == StageKind::vertex) {
            GOBO_TRY(pipeline.inputs, inputs_of(modules.back()));
        }
        if (stage.kind == StageKind::fragment) pipeline.outputs = outputs_of(modules.back());
    }
    std::map<std::string, std::string> names;  // by identity, that of the first stage
    std::map<std::pair<std::string, std::string>, Descriptor> by_name;
    for (const Module& module : modules)
        for (const Variable& variable : module.variables) {
            if (variable.storage == spv::StorageClassAtomicCounter)
                return fail({.message = fmt::format("Vulkan has no atomic counters, and here is one: {}",
                                                    module.name(variable.id)),
                             .help = "count in a storage block, with atomicAdd()",
                             .subject = module.name(variable.id)});
            if (!is_resource(variable)) continue;
            const auto& [identity, name] =
                *names.try_emplace(identity_of(module, variable, is_opengl), name_of(module, variable)).first;
            by_name.try_emplace({name, identity}, descriptor_of(module, variable));
        }
    std::map<std::string, std::uint32_t> binding_of;
    for (const auto& [name, descriptor] : by_name) {
        binding_of[name.second] = static_cast<std::uint32_t>(pipeline.descriptors.size());
        pipeline.descriptors.push_back(descriptor);
    }
    std::vector<Numbers> locations(modules.size());
    if (is_opengl && modules.size() == 2)
        std::tie(locations[0], locations[1]) = matched_locations(modules[0], modules[1]);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        Numbers bindings;
        for (const Variable& variable : modules[i].variables)
            if (is_resource(variable))
                bindings[variable.id] = binding_of.at(identity_of(modules[i], variable, is_opengl));
        stages[i].words = rewritten(modules[i], stages[i].words, bindings, locations[i]);
    }
    pipeline.stages = std::move(stages);
    return pipeline;
}

}  // namespace

Result<Pipeline> pipeline_of(std::vector<PipelineStage> stages) {
    for (PipelineStage& stage : stages) {
        GOBO_TRY(const Module module, spirv::read_module(stage.words));
        const std::string name = fmt::format("{} stage's uniforms outside blocks", name_of(stage.kind));
        GOBO_TRY(stage.words, with_uniform_block(module, stage.words, name));
    }
    return linked(std::move(stages), true);
}

Result<Pipeline> pipeline_of_vulkan(std::vector<PipelineStage> stages) {
    return linked(std::move(stages), false);
}

}  // namespace gobo::cost
