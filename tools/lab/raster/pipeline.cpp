#include "lab/raster/pipeline.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "spirv/module.hpp"

namespace gobo::raster {
namespace {

bool is_derivative(spv::Op opcode) {
    return (opcode >= spv::OpDPdx && opcode <= spv::OpFwidthCoarse) ||
           opcode == spv::OpImageSampleImplicitLod || opcode == spv::OpImageSampleDrefImplicitLod ||
           opcode == spv::OpImageSampleProjImplicitLod || opcode == spv::OpImageSampleProjDrefImplicitLod ||
           opcode == spv::OpImageQueryLod;
}

/// The fine or coarse form of a derivative that is not fine already.
std::optional<spv::Op> form_of(spv::Op opcode, Derivatives derivatives) {
    const bool is_fine = derivatives == Derivatives::fine;
    switch (opcode) {
        case spv::OpDPdx:
        case spv::OpDPdxCoarse:
            return is_fine ? spv::OpDPdxFine : spv::OpDPdxCoarse;
        case spv::OpDPdy:
        case spv::OpDPdyCoarse:
            return is_fine ? spv::OpDPdyFine : spv::OpDPdyCoarse;
        case spv::OpFwidth:
        case spv::OpFwidthCoarse:
            return is_fine ? spv::OpFwidthFine : spv::OpFwidthCoarse;
        default:
            return std::nullopt;
    }
}

/// Takes from the fragment stage's decorations and execution modes what decoding leaves out. The result is
/// how variables are interpolated, by name.
Result<std::map<std::string, Interpolation>> read_facts(std::span<const std::uint32_t> words,
                                                        Pipeline& pipeline) {
    GOBO_TRY(const spirv::Module module, spirv::read_module(words));
    for (const spirv::Instruction& instruction : module.instructions) {
        const bool is_mode = instruction.opcode == spv::OpExecutionMode;
        pipeline.needs_quads |= is_derivative(instruction.opcode);
        pipeline.may_discard |=
            instruction.opcode == spv::OpKill || instruction.opcode == spv::OpTerminateInvocation;
        pipeline.tests_early |= is_mode && instruction.word(2) == spv::ExecutionModeEarlyFragmentTests;
    }
    std::map<std::string, Interpolation> interpolations;
    for (const spirv::Variable& variable : module.variables) {
        if (module.decoration(variable.id, spv::DecorationNoPerspective))
            interpolations[module.name(variable.id)] = Interpolation::linear;
        if (module.decoration(variable.id, spv::DecorationFlat))
            interpolations[module.name(variable.id)] = Interpolation::flat;
    }
    return interpolations;
}

/// The vertex stage's output for an input: by location where both state one, else by name.
const evaluate::Port* source_of(const evaluate::Program& vertex, const evaluate::Port& input) {
    for (const evaluate::Port& output : vertex.outputs)
        if (output.name == input.name || (input.location >= 0 && output.location == input.location))
            return &output;
    return nullptr;
}

}  // namespace

Result<Pipeline> join(evaluate::Program vertex, evaluate::Program fragment,
                      std::span<const std::uint32_t> fragment_module) {
    Pipeline pipeline;
    GOBO_TRY(const auto interpolations, read_facts(fragment_module, pipeline));
    for (const evaluate::Port& input : fragment.inputs) {
        if (input.name.starts_with("gl_")) continue;
        const evaluate::Port* output = source_of(vertex, input);
        if (output == nullptr)
            return fail(Fault::input,
                        fmt::format("the vertex stage does not write the fragment stage's '{}'", input.name));
        const auto found = interpolations.find(input.name.substr(0, input.name.find_first_of(".[")));
        pipeline.varyings.push_back(
            {output->name, input.name, input.components,
             found == interpolations.end() ? Interpolation::perspective : found->second});
    }
    for (const evaluate::Port& output : fragment.outputs)
        if (!output.name.starts_with("gl_") && output.location <= 0) pipeline.color = output.name;
    pipeline.vertex = std::move(vertex);
    pipeline.fragment = std::move(fragment);
    return pipeline;
}

Result<Pipeline> pipeline_of(std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment) {
    GOBO_TRY(evaluate::Program first, evaluate::decode(vertex));
    GOBO_TRY(evaluate::Program second, evaluate::decode(fragment));
    return join(std::move(first), std::move(second), fragment);
}

std::vector<std::uint32_t> with_derivatives(std::span<const std::uint32_t> module, Derivatives derivatives) {
    constexpr std::size_t kHeaderWords = 5;
    constexpr std::uint32_t kOpcodeBits = 0xffff;
    std::vector<std::uint32_t> words(module.begin(), module.end());
    for (std::size_t at = kHeaderWords; at < words.size(); at += std::max(words[at] >> 16U, 1U))
        if (const auto form = form_of(static_cast<spv::Op>(words[at] & kOpcodeBits), derivatives))
            words[at] = (words[at] & ~kOpcodeBits) | static_cast<std::uint32_t>(*form);
    return words;
}

}  // namespace gobo::raster
