#include "verify/software_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "evaluate/module.hpp"
#include "verify/random.hpp"

namespace gobo::verify {
namespace {

constexpr std::size_t kQuad = 4;

/// What decorations of variables and execution modes tell beyond what decoding keeps.
struct ModuleFacts {
    std::map<std::string, Interpolation> interpolations;  ///< of variables, by name
    bool tests_early = false;
    bool has_derivatives = false;
};

bool is_derivative(spv::Op opcode) {
    return (opcode >= spv::OpDPdx && opcode <= spv::OpFwidthCoarse) ||
           opcode == spv::OpImageSampleImplicitLod || opcode == spv::OpImageSampleDrefImplicitLod ||
           opcode == spv::OpImageSampleProjImplicitLod || opcode == spv::OpImageSampleProjDrefImplicitLod ||
           opcode == spv::OpImageQueryLod;
}

Result<ModuleFacts> facts_of(const SpirvModule& words) {
    const Result<evaluate::Module> module = evaluate::read_module(words);
    if (!module) return tl::unexpected(module.error());
    ModuleFacts facts;
    for (const evaluate::Instruction& instruction : module->instructions) {
        if (is_derivative(instruction.opcode)) facts.has_derivatives = true;
        if (instruction.opcode == spv::OpExecutionMode &&
            instruction.word(2) == spv::ExecutionModeEarlyFragmentTests)
            facts.tests_early = true;
        if (instruction.opcode != spv::OpDecorate) continue;
        if (instruction.word(2) == spv::DecorationFlat)
            facts.interpolations[module->name_of(instruction.word(1))] = Interpolation::flat;
        if (instruction.word(2) == spv::DecorationNoPerspective)
            facts.interpolations[module->name_of(instruction.word(1))] = Interpolation::linear;
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

Result<std::vector<SoftwareProgram::Varying>> match(const evaluate::Program& vertex,
                                                    const evaluate::Program& fragment,
                                                    const ModuleFacts& facts) {
    std::vector<SoftwareProgram::Varying> varyings;
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

/// The vector moved by up to `nudge` of its largest component, in each component.
void move(std::vector<double>& values, std::uint32_t components, std::size_t count, double nudge,
          Random& random) {
    if (nudge == 0 || values.size() != components * count) return;
    for (std::size_t i = 0; i < count; ++i) {
        double size = 0;
        for (std::size_t c = 0; c < components; ++c) size = std::max(size, std::abs(values[c * count + i]));
        for (std::size_t c = 0; c < components; ++c)
            values[c * count + i] += size * random.between(-nudge, nudge);
    }
}

/// Where the fragment stage runs: a fragment's own pixel, or its quad's.
struct Invocation {
    const Fragment* fragment = nullptr;
    int x = 0;
    int y = 0;
    Weights weights;
};

std::vector<Invocation> invocations_of(const SoftwareProgram& program, const SoftwareObject& object) {
    std::vector<Invocation> invocations;
    for (const Fragment& fragment : object.fragments) {
        if (!program.needs_quads) {
            invocations.push_back({&fragment, fragment.x, fragment.y, fragment.weights});
            continue;
        }
        const std::uint32_t* corner = &object.indices[3 * std::size_t{fragment.triangle}];
        const Interpolator interpolator(
            {object.positions[corner[0]], object.positions[corner[1]], object.positions[corner[2]]},
            object.width, object.height);
        for (int i = 0; i < static_cast<int>(kQuad); ++i) {
            const int x = (fragment.x & ~1) + i % 2;
            const int y = (fragment.y & ~1) + i / 2;
            invocations.push_back({&fragment, x, y, interpolator.at(x + 0.5, y + 0.5)});
        }
    }
    return invocations;
}

/// The place of a fragment's own invocation among invocations_of().
std::size_t own_invocation(const SoftwareProgram& program, const Fragment& fragment, std::size_t index) {
    if (!program.needs_quads) return index;
    return kQuad * index + static_cast<std::size_t>(fragment.x % 2 + 2 * (fragment.y % 2));
}

double interpolated(const std::vector<double>& values, std::size_t first, const std::uint32_t* corner,
                    const Weights& weights, Interpolation interpolation) {
    // OpenGL's last vertex is the provoking one unless told otherwise.
    if (interpolation == Interpolation::flat) return values[first + corner[2]];
    const auto& shares = interpolation == Interpolation::linear ? weights.linear : weights.perspective;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += shares[i] * values[first + corner[i]];
    return sum;
}

/// The fragment stage's inputs at each invocation.
evaluate::Invocations fragment_inputs(const SoftwareProgram& program, const SoftwareObject& object,
                                      const std::vector<Invocation>& places, const evaluate::Outputs& outputs,
                                      double nudge, Random& random) {
    evaluate::Invocations invocations = object.uniforms;
    invocations.count = places.size();
    for (const SoftwareProgram::Varying& varying : program.varyings) {
        const std::vector<double>& from = outputs.values.at(varying.output);
        std::vector<double>& to = invocations.values[varying.input];
        to.resize(varying.components * places.size());
        for (std::uint32_t c = 0; c < varying.components; ++c) {
            for (std::size_t i = 0; i < places.size(); ++i)
                to[c * places.size() + i] = interpolated(
                    from, c * outputs.count, &object.indices[3 * std::size_t{places[i].fragment->triangle}],
                    places[i].weights, varying.interpolation);
        }
        if (varying.interpolation != Interpolation::flat)
            move(to, varying.components, places.size(), nudge, random);
    }
    for (const evaluate::Port& port : program.fragment.inputs) {
        if (port.name != "gl_FragCoord" && port.name != "gl_FrontFacing") continue;
        std::vector<double>& to = invocations.values[port.name];
        to.resize(port.components * places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Invocation& place = places[i];
            const double front = place.fragment->is_front_facing ? 1 : 0;
            const std::array<double, 4> at = {place.x + 0.5, place.y + 0.5, place.weights.depth,
                                              place.weights.inverse_w};
            for (std::size_t c = 0; c < port.components; ++c)
                to[c * places.size() + i] = port.name == "gl_FragCoord" ? at[c] : front;
        }
    }
    return invocations;
}

/// A depth as its buffer holds it.
double stored_depth(double depth) {
    return static_cast<float>(std::clamp(depth, 0.0, 1.0));
}

Shaded shaded(const SoftwareProgram& program, const evaluate::Outputs& outputs, std::size_t invocation,
              const Fragment& fragment) {
    Shaded result;
    result.depth = stored_depth(fragment.weights.depth);
    result.is_discarded = outputs.discarded[invocation];
    if (const auto color = outputs.values.find(program.color); color != outputs.values.end())
        for (std::size_t c = 0; c < std::min<std::size_t>(color->second.size() / outputs.count, 4); ++c)
            result.color[c] = color->second[c * outputs.count + invocation];
    const auto depth = outputs.values.find("gl_FragDepth");
    if (depth != outputs.values.end() && !program.tests_early)
        result.depth = stored_depth(depth->second[invocation]);
    return result;
}

Result<SoftwareObject> rasterise_object(const SoftwareProgram& program, const Interface& interface,
                                        const Object& object, const std::vector<RenderValue>& values,
                                        const ViewedObject& viewed) {
    Result<evaluate::Invocations> vertices = uniforms_of(program.vertex, interface, values, viewed);
    if (!vertices) return tl::unexpected(vertices.error());
    Result<evaluate::Invocations> uniforms = uniforms_of(program.fragment, interface, values, viewed);
    if (!uniforms) return tl::unexpected(uniforms.error());
    add_attributes(program.vertex, object.mesh, values, *vertices);
    const Result<evaluate::Outputs> outputs = evaluate::run<float>(program.vertex, *vertices);
    if (!outputs) return tl::unexpected(outputs.error());
    SoftwareObject result;
    result.width = static_cast<int>(viewed.viewport.x);
    result.height = static_cast<int>(viewed.viewport.y);
    result.vertices = std::move(*vertices);
    result.uniforms = std::move(*uniforms);
    result.indices = object.mesh.indices;
    const auto position = outputs->values.find("gl_Position");
    if (position == outputs->values.end())
        return fail(Fault::input, "the vertex stage does not write gl_Position");
    for (std::size_t i = 0; i < outputs->count; ++i) {
        glm::dvec4& to = result.positions.emplace_back();
        for (int c = 0; c < 4; ++c)
            to[c] = position->second[static_cast<std::size_t>(c) * outputs->count + i];
    }
    result.fragments = rasterise(result.positions, result.indices, result.width, result.height);
    return result;
}

}  // namespace

Result<SoftwareProgram> software_program(const SpirvModule& vertex, const SpirvModule& fragment) {
    SoftwareProgram program;
    Result<evaluate::Program> first = evaluate::decode(vertex);
    if (!first) return tl::unexpected(first.error());
    Result<evaluate::Program> second = evaluate::decode(fragment);
    if (!second) return tl::unexpected(second.error());
    const Result<ModuleFacts> facts = facts_of(fragment);
    if (!facts) return tl::unexpected(facts.error());
    auto varyings = match(*first, *second, *facts);
    if (!varyings) return tl::unexpected(varyings.error());
    program.vertex = std::move(*first);
    program.fragment = std::move(*second);
    program.varyings = std::move(*varyings);
    program.needs_quads = facts->has_derivatives;
    program.tests_early = facts->tests_early;
    for (const evaluate::Port& output : program.fragment.outputs)
        if (!output.name.starts_with("gl_") && output.location <= 0) program.color = output.name;
    return program;
}

Result<std::vector<SoftwareObject>> rasterise_objects(const SoftwareProgram& program,
                                                      const Interface& interface,
                                                      const std::vector<Object>& objects,
                                                      const std::vector<RenderValue>& values,
                                                      const View& view) {
    ViewedObject viewed;
    viewed.view = view.camera.view();
    viewed.projection = view.camera.projection(static_cast<double>(view.width) / view.height);
    viewed.viewport = {view.width, view.height};
    std::vector<SoftwareObject> result;
    for (const Object& object : objects) {
        viewed.model = object.model;
        std::vector<RenderValue> all = values;
        all.insert(all.end(), object.values.begin(), object.values.end());
        Result<SoftwareObject> one = rasterise_object(program, interface, object, all, viewed);
        if (!one) return tl::unexpected(one.error());
        result.push_back(std::move(*one));
    }
    return result;
}

Result<std::vector<Shaded>> shade(const SoftwareProgram& program, const SoftwareObject& object, double nudge,
                                  std::uint64_t seed) {
    if (object.fragments.empty()) return std::vector<Shaded>{};
    Random random(seed);
    evaluate::Invocations vertices = object.vertices;
    for (const evaluate::Port& port : program.vertex.inputs)
        if (const auto found = vertices.values.find(port.name); found != vertices.values.end())
            move(found->second, port.components, vertices.count, nudge, random);
    const Result<evaluate::Outputs> varyings = evaluate::run<float>(program.vertex, vertices);
    if (!varyings) return tl::unexpected(varyings.error());
    const std::vector<Invocation> places = invocations_of(program, object);
    const evaluate::Invocations inputs = fragment_inputs(program, object, places, *varyings, nudge, random);
    const Result<evaluate::Outputs> outputs = evaluate::run<float>(program.fragment, inputs);
    if (!outputs) return tl::unexpected(outputs.error());
    std::vector<Shaded> result;
    for (std::size_t i = 0; i < object.fragments.size(); ++i)
        result.push_back(
            shaded(program, *outputs, own_invocation(program, object.fragments[i], i), object.fragments[i]));
    return result;
}

}  // namespace gobo::verify
