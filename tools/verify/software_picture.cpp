#include "verify/software_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "verify/random.hpp"

namespace gobo::verify {
namespace {

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

/// The fragment stage's inputs at each invocation.
evaluate::Invocations fragment_inputs(const SoftwareProgram& program, const SoftwareObject& object,
                                      const std::vector<FragmentPlace>& places,
                                      const evaluate::Outputs& outputs, double nudge, Random& random) {
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
        if (varying.interpolation != Interpolation::flat)
            move(to, varying.components, places.size(), nudge, random);
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

Raster raster_of(const SoftwareObject& object) {
    return {object.fragments, object.indices, object.positions, object.width, object.height};
}

void give_images(const evaluate::Program& program, const evaluate::Images& images,
                 evaluate::Invocations& invocations) {
    for (const evaluate::ImagePort& port : program.images)
        if (const auto given = images.find(port.name); given != images.end())
            invocations.images[port.name] = given->second;
}

/// The vertices of those numbers, in their order.
evaluate::Invocations selected(const evaluate::Program& program, const evaluate::Invocations& all,
                               const std::vector<std::uint32_t>& numbers) {
    evaluate::Invocations result = all;
    result.count = numbers.size();
    for (const evaluate::Port& port : program.inputs) {
        const auto from = all.values.find(port.name);
        if (from == all.values.end() || from->second.size() == port.components) continue;
        std::vector<double>& to = result.values[port.name];
        to.resize(port.components * numbers.size());
        for (std::size_t c = 0; c < port.components; ++c)
            for (std::size_t i = 0; i < numbers.size(); ++i)
                to[c * numbers.size() + i] = from->second[c * all.count + numbers[i]];
    }
    return result;
}

void add(const evaluate::Counts& counts, evaluate::Counts& sum) {
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) sum[kind] += counts[kind];
}

}  // namespace

Result<SoftwareProgram> software_program(const SpirvModule& vertex, const SpirvModule& fragment) {
    SoftwareProgram program;
    Result<evaluate::Program> first = evaluate::decode(vertex);
    if (!first) return tl::unexpected(first.error());
    Result<evaluate::Program> second = evaluate::decode(fragment);
    if (!second) return tl::unexpected(second.error());
    Result<Link> joined = link(*first, *second, fragment);
    if (!joined) return tl::unexpected(joined.error());
    program.vertex = std::move(*first);
    program.fragment = std::move(*second);
    program.link = std::move(*joined);
    for (const evaluate::Port& output : program.fragment.outputs)
        if (!output.name.starts_with("gl_") && output.location <= 0) program.color = output.name;
    return program;
}

Result<SoftwareObject> rasterise_object(const SoftwareProgram& program, const Interface& interface,
                                        const Object& object, const std::vector<RenderValue>& family_values,
                                        ViewedObject viewed, const evaluate::Images& images) {
    viewed.model = object.model;
    std::vector<RenderValue> values = family_values;
    values.insert(values.end(), object.values.begin(), object.values.end());
    Result<evaluate::Invocations> vertices = uniforms_of(program.vertex, interface, values, viewed);
    if (!vertices) return tl::unexpected(vertices.error());
    Result<evaluate::Invocations> uniforms = uniforms_of(program.fragment, interface, values, viewed);
    if (!uniforms) return tl::unexpected(uniforms.error());
    give_images(program.vertex, images, *vertices);
    give_images(program.fragment, images, *uniforms);
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
    if (object.culls_back_faces)
        std::erase_if(result.fragments, [mirrored = object.is_mirrored()](const Fragment& fragment) {
            return fragment.is_front_facing == mirrored;
        });
    return result;
}

Result<std::vector<SoftwareObject>> rasterise_objects(const SoftwareProgram& program,
                                                      const Interface& interface,
                                                      const std::vector<Object>& objects,
                                                      const std::vector<RenderValue>& values,
                                                      const View& view, const evaluate::Images& images) {
    ViewedObject viewed;
    viewed.view = view.camera.view();
    viewed.projection = view.camera.projection(static_cast<double>(view.width) / view.height);
    viewed.viewport = {view.width, view.height};
    std::vector<SoftwareObject> result;
    for (const Object& object : objects) {
        Result<SoftwareObject> one = rasterise_object(program, interface, object, values, viewed, images);
        if (!one) return tl::unexpected(one.error());
        result.push_back(std::move(*one));
    }
    return result;
}

SoftwareObject part_of(const SoftwareProgram& program, const SoftwareObject& object,
                       const std::function<bool(int, int)>& is_wanted) {
    SoftwareObject part;
    part.uniforms = object.uniforms;
    part.width = object.width;
    part.height = object.height;
    std::map<std::uint32_t, std::uint32_t> triangles;
    std::map<std::uint32_t, std::uint32_t> vertices;
    std::vector<std::uint32_t> kept;
    const auto number_of = [&](std::uint32_t vertex) {
        const auto [known, is_new] = vertices.emplace(vertex, static_cast<std::uint32_t>(kept.size()));
        if (is_new) {
            kept.push_back(vertex);
            part.positions.push_back(object.positions[vertex]);
        }
        return known->second;
    };
    for (const Fragment& fragment : object.fragments) {
        if (!is_wanted(fragment.x, fragment.y)) continue;
        const auto [known, is_new] =
            triangles.emplace(fragment.triangle, static_cast<std::uint32_t>(triangles.size()));
        for (std::size_t corner = 0; is_new && corner < 3; ++corner)
            part.indices.push_back(number_of(object.indices[3 * std::size_t{fragment.triangle} + corner]));
        part.fragments.push_back(fragment);
        part.fragments.back().triangle = known->second;
    }
    part.vertices = selected(program.vertex, object.vertices, kept);
    return part;
}

Result<evaluate::Invocations> exact_fragment_inputs(const SoftwareProgram& program,
                                                    const SoftwareObject& object) {
    const Result<evaluate::Outputs> varyings = evaluate::run<double>(program.vertex, object.vertices);
    if (!varyings) return tl::unexpected(varyings.error());
    Random unused(0);
    return fragment_inputs(program, object, places_of(raster_of(object), false), *varyings, 0, unused);
}

template <class T>
Result<std::vector<Shaded>> shade_in(const SoftwareProgram& program, const SoftwareObject& object,
                                     Work* work) {
    if (object.fragments.empty()) return std::vector<Shaded>{};
    evaluate::Options options;
    options.count = work != nullptr;
    const Result<evaluate::Outputs> varyings = evaluate::run<T>(program.vertex, object.vertices, options);
    if (!varyings) return tl::unexpected(varyings.error());
    const bool in_quads = program.link.needs_quads;
    Random unused(0);
    const evaluate::Invocations inputs =
        fragment_inputs(program, object, places_of(raster_of(object), in_quads), *varyings, 0, unused);
    const Result<evaluate::Outputs> outputs = evaluate::run<T>(program.fragment, inputs, options);
    if (!outputs) return tl::unexpected(outputs.error());
    std::vector<Shaded> result;
    for (std::size_t i = 0; i < object.fragments.size(); ++i) {
        const std::size_t own = own_place(object.fragments[i], i, in_quads);
        result.push_back(shaded(program, *outputs, own, object.fragments[i]));
        if (work != nullptr) add(outputs->counts[own], work->fragments);
    }
    if (work != nullptr)
        for (const evaluate::Counts& counts : varyings->counts) add(counts, work->vertices);
    return result;
}

template Result<std::vector<Shaded>> shade_in<float>(const SoftwareProgram&, const SoftwareObject&, Work*);
template Result<std::vector<Shaded>> shade_in<double>(const SoftwareProgram&, const SoftwareObject&, Work*);

Result<std::vector<Shaded>> shade(const SoftwareProgram& program, const SoftwareObject& object, double nudge,
                                  std::uint64_t seed, evaluate::Counts* operations) {
    if (object.fragments.empty()) return std::vector<Shaded>{};
    Random random(seed);
    evaluate::Invocations vertices = object.vertices;
    for (const evaluate::Port& port : program.vertex.inputs)
        if (const auto found = vertices.values.find(port.name); found != vertices.values.end())
            move(found->second, port.components, vertices.count, nudge, random);
    const Result<evaluate::Outputs> varyings = evaluate::run<float>(program.vertex, vertices);
    if (!varyings) return tl::unexpected(varyings.error());
    const std::vector<FragmentPlace> places = places_of(raster_of(object), program.link.needs_quads);
    const evaluate::Invocations inputs = fragment_inputs(program, object, places, *varyings, nudge, random);
    evaluate::Options options;
    options.count = operations != nullptr;
    const Result<evaluate::Outputs> outputs = evaluate::run<float>(program.fragment, inputs, options);
    if (!outputs) return tl::unexpected(outputs.error());
    for (const evaluate::Counts& counts : outputs->counts)
        for (std::size_t kind = 0; kind < counts.size(); ++kind) (*operations)[kind] += counts[kind];
    std::vector<Shaded> result;
    for (std::size_t i = 0; i < object.fragments.size(); ++i)
        result.push_back(shaded(program, *outputs,
                                own_place(object.fragments[i], i, program.link.needs_quads),
                                object.fragments[i]));
    return result;
}

}  // namespace gobo::verify
