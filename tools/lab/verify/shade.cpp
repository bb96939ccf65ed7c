#include "lab/verify/shade.hpp"

#include <algorithm>
#include <cmath>

#include "lab/verify/random.hpp"

namespace gobo::verify {
namespace {

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
    if (depth != outputs.values.end() && !program.link.tests_early)
        result.depth = stored_depth(depth->second[invocation]);
    return result;
}

void add(const evaluate::Counts& counts, evaluate::Counts& sum) {
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) sum[kind] += counts[kind];
}

/// Each component moved at random by up to `by` of the largest of its vector.
void move(std::vector<double>& values, std::uint32_t components, std::size_t count, double by,
          Random& random) {
    if (by == 0 || values.size() != components * count) return;
    for (std::size_t i = 0; i < count; ++i) {
        double size = 0;
        for (std::size_t c = 0; c < components; ++c) size = std::max(size, std::abs(values[c * count + i]));
        for (std::size_t c = 0; c < components; ++c) values[c * count + i] += size * random.between(-by, by);
    }
}

/// All fragments' inputs, moved at random.
void move(const Link& link, double by, Random& random, evaluate::Invocations& inputs) {
    for (const Varying& varying : link.varyings)
        if (varying.interpolation != Interpolation::flat)
            move(inputs.values[varying.input], varying.components, inputs.count, by, random);
}

Raster raster_of(const SoftwareObject& object) {
    return {object.fragments, object.indices, object.positions, object.width, object.height};
}

}  // namespace

std::vector<FragmentPlace> shading_places(const SoftwareProgram& program, const SoftwareObject& object) {
    return places_of(raster_of(object), program.link.needs_quads);
}

evaluate::Invocations fragment_inputs(const SoftwareProgram& program, const SoftwareObject& object,
                                      const std::vector<FragmentPlace>& places,
                                      const evaluate::Outputs& outputs) {
    evaluate::Invocations invocations = object.uniforms;
    invocations.count = places.size();
    for (const Varying& varying : program.link.varyings) {
        const std::vector<double>& from = outputs.values.at(varying.output);
        std::vector<double>& to = invocations.values[varying.input];
        to.resize(varying.components * places.size());
        for (std::uint32_t c = 0; c < varying.components; ++c) {
            const double* first = &from[c * outputs.count];
            for (std::size_t i = 0; i < places.size(); ++i) {
                const std::uint32_t* corner = &object.indices[3 * std::size_t{places[i].fragment->triangle}];
                to[c * places.size() + i] =
                    interpolated({first[corner[0]], first[corner[1]], first[corner[2]]}, places[i].weights,
                                 varying.interpolation);
            }
        }
    }
    for (const evaluate::Port& port : program.fragment.inputs) {
        if (port.name != "gl_FragCoord" && port.name != "gl_FrontFacing") continue;
        std::vector<double>& to = invocations.values[port.name];
        to.resize(port.components * places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double front = places[i].fragment->is_front_facing ? 1 : 0;
            const std::array<double, 4> at = window_position(places[i]);
            for (std::size_t c = 0; c < port.components; ++c)
                to[c * places.size() + i] = port.name == "gl_FragCoord" ? at[c] : front;
        }
    }
    return invocations;
}

Result<std::vector<Shaded>> shade_fragments(const SoftwareProgram& program, const SoftwareObject& object,
                                            const evaluate::Invocations& inputs,
                                            evaluate::Counts* operations) {
    evaluate::Options options;
    options.count = operations != nullptr;
    const Result<evaluate::Outputs> outputs = evaluate::run<float>(program.fragment, inputs, options);
    if (!outputs) return tl::unexpected(outputs.error());
    if (operations != nullptr)
        for (const evaluate::Counts& counts : outputs->counts) add(counts, *operations);
    std::vector<Shaded> result;
    for (std::size_t i = 0; i < object.fragments.size(); ++i)
        result.push_back(shaded(program, *outputs,
                                own_place(object.fragments[i], i, program.link.needs_quads),
                                object.fragments[i]));
    return result;
}

Result<evaluate::Invocations> exact_fragment_inputs(const SoftwareProgram& program,
                                                    const SoftwareObject& object) {
    const Result<evaluate::Outputs> varyings = evaluate::run<double>(program.vertex, object.vertices);
    if (!varyings) return tl::unexpected(varyings.error());
    return fragment_inputs(program, object, places_of(raster_of(object), false), *varyings);
}

template <class T>
Result<std::vector<Shaded>> shade_in(const SoftwareProgram& program, const SoftwareObject& object,
                                     Work* work) {
    if (object.fragments.empty()) return std::vector<Shaded>{};
    evaluate::Options options;
    options.count = work != nullptr;
    const Result<evaluate::Outputs> varyings = evaluate::run<T>(program.vertex, object.vertices, options);
    if (!varyings) return tl::unexpected(varyings.error());
    const evaluate::Invocations inputs =
        fragment_inputs(program, object, shading_places(program, object), *varyings);
    const Result<evaluate::Outputs> outputs = evaluate::run<T>(program.fragment, inputs, options);
    if (!outputs) return tl::unexpected(outputs.error());
    std::vector<Shaded> result;
    for (std::size_t i = 0; i < object.fragments.size(); ++i) {
        const std::size_t own = own_place(object.fragments[i], i, program.link.needs_quads);
        result.push_back(shaded(program, *outputs, own, object.fragments[i]));
        if (work != nullptr) add(outputs->counts[own], work->fragments);
    }
    if (work != nullptr)
        for (const evaluate::Counts& counts : varyings->counts) add(counts, work->vertices);
    return result;
}

template Result<std::vector<Shaded>> shade_in<float>(const SoftwareProgram&, const SoftwareObject&, Work*);
template Result<std::vector<Shaded>> shade_in<double>(const SoftwareProgram&, const SoftwareObject&, Work*);

Result<std::vector<Shaded>> shade(const SoftwareProgram& program, const SoftwareObject& object,
                                  const Nudge& nudge, evaluate::Counts* operations) {
    if (object.fragments.empty()) return std::vector<Shaded>{};
    Random random(nudge.seed);
    evaluate::Invocations vertices = object.vertices;
    for (const evaluate::Port& port : program.vertex.inputs)
        if (const auto found = vertices.values.find(port.name); found != vertices.values.end())
            move(found->second, port.components, vertices.count, nudge.by, random);
    const Result<evaluate::Outputs> varyings = evaluate::run<float>(program.vertex, vertices);
    if (!varyings) return tl::unexpected(varyings.error());
    evaluate::Invocations inputs =
        fragment_inputs(program, object, shading_places(program, object), *varyings);
    move(program.link, nudge.by, random, inputs);
    return shade_fragments(program, object, inputs, operations);
}

}  // namespace gobo::verify
