#include "lab/verify/software_picture.hpp"

#include <map>

#include <fmt/format.h>

namespace gobo::verify {
namespace {

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

}  // namespace gobo::verify
