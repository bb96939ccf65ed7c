#include "lab/verify/link.hpp"

#include <map>

#include <fmt/format.h>

#include "spirv/module.hpp"

namespace gobo::verify {
namespace {

constexpr int kQuad = 4;

/// What decorations of variables and execution modes tell beyond what decoding keeps.
struct ModuleFacts {
    std::map<std::string, Interpolation> interpolations;  ///< of variables, by name
    bool tests_early = false;
    bool has_derivatives = false;
    bool has_discard = false;
};

bool is_derivative(spv::Op opcode) {
    return (opcode >= spv::OpDPdx && opcode <= spv::OpFwidthCoarse) ||
           opcode == spv::OpImageSampleImplicitLod || opcode == spv::OpImageSampleDrefImplicitLod ||
           opcode == spv::OpImageSampleProjImplicitLod || opcode == spv::OpImageSampleProjDrefImplicitLod ||
           opcode == spv::OpImageQueryLod;
}

Result<ModuleFacts> facts_of(const SpirvModule& words) {
    GOBO_TRY(const spirv::Module module, spirv::read_module(words));
    ModuleFacts facts;
    for (const spirv::Instruction& instruction : module.instructions) {
        if (is_derivative(instruction.opcode)) facts.has_derivatives = true;
        if (instruction.opcode == spv::OpKill || instruction.opcode == spv::OpTerminateInvocation)
            facts.has_discard = true;
        if (instruction.opcode == spv::OpExecutionMode &&
            instruction.word(2) == spv::ExecutionModeEarlyFragmentTests)
            facts.tests_early = true;
        if (instruction.opcode != spv::OpDecorate) continue;
        if (instruction.word(2) == spv::DecorationFlat)
            facts.interpolations[module.name(instruction.id(1))] = Interpolation::flat;
        if (instruction.word(2) == spv::DecorationNoPerspective)
            facts.interpolations[module.name(instruction.id(1))] = Interpolation::linear;
    }
    return facts;
}

/// The vertex stage's output for an input: by location where both state one, else by name.
const evaluate::Port* source_of(const evaluate::Program& vertex, const evaluate::Port& input) {
    for (const evaluate::Port& output : vertex.outputs)
        if (output.name == input.name || (input.location >= 0 && output.location == input.location))
            return &output;
    return nullptr;
}

Result<std::vector<Varying>> match(const evaluate::Program& vertex, const evaluate::Program& fragment,
                                   const ModuleFacts& facts) {
    std::vector<Varying> varyings;
    for (const evaluate::Port& input : fragment.inputs) {
        if (input.name.starts_with("gl_")) continue;
        const evaluate::Port* output = source_of(vertex, input);
        if (output == nullptr)
            return fail(Fault::input,
                        fmt::format("the vertex stage does not write the fragment stage's '{}'", input.name));
        const std::string variable = input.name.substr(0, input.name.find_first_of(".["));
        const auto found = facts.interpolations.find(variable);
        varyings.push_back(
            {output->name, input.name, input.components,
             found == facts.interpolations.end() ? Interpolation::perspective : found->second});
    }
    return varyings;
}

}  // namespace

Result<Link> link(const evaluate::Program& vertex, const evaluate::Program& fragment,
                  const SpirvModule& module) {
    const Result<ModuleFacts> facts = facts_of(module);
    if (!facts) return tl::unexpected(facts.error());
    auto varyings = match(vertex, fragment, *facts);
    if (!varyings) return tl::unexpected(varyings.error());
    return Link{std::move(*varyings), facts->has_derivatives, facts->tests_early, facts->has_discard};
}

std::vector<FragmentPlace> places_of(const Raster& raster, bool in_quads) {
    std::vector<FragmentPlace> places;
    for (const Fragment& fragment : raster.fragments) {
        if (!in_quads) {
            places.push_back({&fragment, fragment.x, fragment.y, fragment.weights});
            continue;
        }
        const auto corner = raster.indices.subspan(3 * std::size_t{fragment.triangle}, 3);
        const Interpolator interpolator(
            {raster.positions[corner[0]], raster.positions[corner[1]], raster.positions[corner[2]]},
            raster.width, raster.height);
        for (int i = 0; i < kQuad; ++i) {
            const int x = (fragment.x & ~1) + i % 2;
            const int y = (fragment.y & ~1) + i / 2;
            places.push_back({&fragment, x, y, interpolator.at(x + 0.5, y + 0.5)});
        }
    }
    return places;
}

std::size_t own_place(const Fragment& fragment, std::size_t index, bool in_quads) {
    if (!in_quads) return index;
    return kQuad * index + static_cast<std::size_t>(fragment.x % 2 + 2 * (fragment.y % 2));
}

double interpolated(const std::array<double, 3>& corners, const Weights& weights,
                    Interpolation interpolation) {
    if (interpolation == Interpolation::flat) return corners[2];
    const auto& shares = interpolation == Interpolation::linear ? weights.linear : weights.perspective;
    return shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2];
}

std::array<double, 4> window_position(const FragmentPlace& place) {
    return {place.x + 0.5, place.y + 0.5, place.weights.depth, place.weights.inverse_w};
}

}  // namespace gobo::verify
