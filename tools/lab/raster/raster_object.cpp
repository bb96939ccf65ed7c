#include "lab/raster/raster_object.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "lab/evaluate/images.hpp"
#include "lab/render/mesh.hpp"
#include "lab/render/texture.hpp"

namespace gobo::raster {
namespace {

bool has_port(const std::vector<evaluate::Port>& ports, const std::string& name) {
    return std::any_of(ports.begin(), ports.end(),
                       [&](const evaluate::Port& port) { return port.name == name; });
}

/// A plain uniform's elements under their own names.
void add_plain_uniform(const evaluate::Program& program, const Assignment& assignment,
                       evaluate::Invocations& invocations) {
    const auto type = glsl_type(assignment.leaf.type);
    if (!type) return;
    const auto components = static_cast<std::size_t>(type->components());
    const std::string& name = assignment.leaf.name;
    for (std::size_t i = 0; (i + 1) * components <= assignment.numbers.size(); ++i) {
        const std::string element = assignment.leaf.is_array && !has_port(program.uniforms, name)
                                        ? fmt::format("{}[{}]", name, i)
                                        : name;
        if (!has_port(program.uniforms, element)) continue;
        const double* first = assignment.numbers.data() + i * components;
        invocations.values[element] = std::vector<double>(first, first + components);
    }
}

/// The given images; else a texture of one colour answers the comparison, its size, or the colour.
void add_images(const evaluate::Program& program, const std::vector<RenderValue>& values,
                const evaluate::Images& images, evaluate::Invocations& invocations) {
    for (const evaluate::ImagePort& port : program.images) {
        if (const auto given = images.find(port.name); given != images.end()) {
            invocations.images.insert(*given);
            continue;
        }
        const RenderValue* value = find_value(values, port.name.substr(0, port.name.find('[')));
        std::array<double, 4> color = {0, 0, 0, 1};
        if (value != nullptr)
            std::copy_n(value->numbers.begin(), std::min<std::size_t>(value->numbers.size(), 4),
                        color.begin());
        const int side = port.type.depth ? 1 : 64;
        invocations.images[port.name] = [=](const evaluate::ImageRequest& request) {
            return evaluate::answer(color, request, side);
        };
    }
}

/// Component by component, all vertices of each.
std::vector<double> by_component(const AttributeValues& values, std::uint32_t components) {
    if (!values.integers.empty()) return {values.integers.begin(), values.integers.end()};
    const auto own = static_cast<std::size_t>(values.components);
    const std::size_t count = values.floats.size() / own;
    std::vector<double> numbers(components * count, 0);
    for (std::size_t c = 0; c < components; ++c)
        for (std::size_t i = 0; i < count; ++i)
            // What an attribute lacks is 0, and its fourth component 1 (OpenGL 4.5, 10.2).
            numbers[c * count + i] = c < own ? values.floats[i * own + c] : (c == 3 ? 1.0 : 0.0);
    return numbers;
}

/// The uniforms and textures of one object for a stage; no inputs yet.
Result<evaluate::Invocations> uniforms_of(const evaluate::Program& program, const Interface& interface,
                                          const std::vector<RenderValue>& values, const ViewedObject& view,
                                          const evaluate::Images& images) {
    GOBO_TRY(const auto resolved, resolve_uniforms(interface, values, view));
    evaluate::Invocations invocations;
    const auto reads = [&](const Block& block) {
        return std::ranges::count(program.uniform_blocks, block.name, &evaluate::UniformBlock::name) > 0;
    };
    for (const Block& block : interface.blocks)
        if (reads(block)) invocations.blocks[block.name] = bytes_of(block, resolved.assignments);
    for (const Block& block : interface.push_constants)
        if (reads(block)) invocations.blocks[block.name] = pushed_bytes(interface, resolved.assignments);
    for (const Assignment& assignment : resolved.assignments)
        if (assignment.leaf.block.empty()) add_plain_uniform(program, assignment, invocations);
    add_images(program, values, images, invocations);
    return invocations;
}

/// One invocation of the vertex stage for each vertex of the mesh.
void add_attributes(const evaluate::Program& program, const Mesh& mesh,
                    const std::vector<RenderValue>& values, evaluate::Invocations& invocations) {
    invocations.count = mesh.positions.size();
    for (const evaluate::Port& port : program.inputs) {
        if (port.name == "gl_VertexID" || port.name == "gl_VertexIndex") {
            std::vector<double>& numbers = invocations.values[port.name];
            numbers.resize(invocations.count);
            std::iota(numbers.begin(), numbers.end(), 0.0);
        }
        if (port.name.starts_with("gl_")) continue;  // gl_InstanceID and the like are 0
        const RenderValue* value = find_value(values, port.name);
        const std::string source(value != nullptr ? value->source : attribute_source_of(port.name));
        std::vector<double>& numbers = invocations.values[port.name];
        if (value != nullptr && source.empty()) {
            numbers = value->numbers;
            while (numbers.size() < port.components) numbers.push_back(numbers.size() == 3 ? 1 : 0);
        } else if (const auto own = attribute_values(mesh, source)) {
            numbers = by_component(*own, port.components);
        } else {
            numbers.assign(port.components, source == "color" ? 1 : 0);
        }
    }
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

std::vector<RenderValue> with_plain_textures(const Interface& interface, std::vector<RenderValue> values) {
    for (const Sampler& sampler : interface.samplers) {
        const RenderValue* given = find_value(values, sampler.name);
        if (given != nullptr && !given->numbers.empty()) continue;
        const bool is_depth = sampler.type.find("Shadow") != std::string::npos;
        RenderValue plain;
        plain.name = sampler.name;
        plain.numbers = {0.25, 0.5, 0.75, 1};
        if (is_depth) plain.numbers = {1};
        if (!has_texture(sampler.type)) plain.numbers = {0, 0, 0, 1};  // as the renderer's reads
        values.push_back(std::move(plain));
    }
    return values;
}

Interpolator RasterObject::interpolator(std::uint32_t triangle) const {
    const std::uint32_t* corner = &indices[3 * std::size_t{triangle}];
    return {{positions[corner[0]], positions[corner[1]], positions[corner[2]]}, width, height};
}

Result<RasterObject> object_inputs(const Pipeline& pipeline, const Interface& interface, const Mesh& mesh,
                                   const std::vector<RenderValue>& values, const ViewedObject& view,
                                   const evaluate::Images& images) {
    RasterObject object;
    GOBO_TRY(object.vertices, uniforms_of(pipeline.vertex, interface, values, view, images));
    GOBO_TRY(object.uniforms, uniforms_of(pipeline.fragment, interface, values, view, images));
    add_attributes(pipeline.vertex, mesh, values, object.vertices);
    object.indices = mesh.indices;
    object.width = static_cast<int>(view.viewport.x);
    object.height = static_cast<int>(view.viewport.y);
    return object;
}

Result<RasterObject> rasterise_object(const Pipeline& pipeline, const Interface& interface,
                                      const Object& object, const std::vector<RenderValue>& family_values,
                                      ViewedObject viewed, const evaluate::Images& images,
                                      ClipSpace clip_space) {
    viewed.model = object.model;
    std::vector<RenderValue> values = family_values;
    values.insert(values.end(), object.values.begin(), object.values.end());
    GOBO_TRY(RasterObject result, object_inputs(pipeline, interface, object.mesh, values, viewed, images));
    result.clip_space = clip_space;
    GOBO_TRY(const auto outputs, evaluate::run<float>(pipeline.vertex, result.vertices));
    const auto position = outputs.values.find("gl_Position");
    if (position == outputs.values.end())
        return fail(Fault::input, "the vertex stage does not write gl_Position");
    const glm::dmat4 to_opengl =
        clip_space == ClipSpace::vulkan ? glm::inverse(vulkan_clip_space_of_pictures()) : glm::dmat4(1);
    for (std::size_t i = 0; i < outputs.count; ++i) {
        glm::dvec4& to = result.positions.emplace_back();
        for (int c = 0; c < 4; ++c) to[c] = position->second[static_cast<std::size_t>(c) * outputs.count + i];
        to = to_opengl * to;
    }
    result.fragments = rasterise(result.positions, result.indices, result.width, result.height);
    if (object.culls_back_faces)
        std::erase_if(result.fragments, [mirrored = object.is_mirrored()](const Fragment& fragment) {
            return fragment.is_front_facing == mirrored;
        });
    return result;
}

Result<std::vector<RasterObject>> rasterise_objects(const Pipeline& pipeline, const Interface& interface,
                                                    const std::vector<Object>& objects,
                                                    const std::vector<RenderValue>& values, const View& view,
                                                    const evaluate::Images& images, ClipSpace clip_space) {
    ViewedObject viewed = viewed_from(view);
    if (clip_space == ClipSpace::vulkan)
        viewed.projection = vulkan_clip_space_of_pictures() * viewed.projection;
    std::vector<RasterObject> result;
    for (const Object& object : objects) {
        GOBO_TRY(RasterObject one,
                 rasterise_object(pipeline, interface, object, values, viewed, images, clip_space));
        result.push_back(std::move(one));
    }
    return result;
}

std::vector<std::uint32_t> drop_unseen_triangles(RasterObject& object) {
    const std::vector<std::uint32_t> indices = std::exchange(object.indices, {});
    const std::vector<glm::dvec4> positions = std::exchange(object.positions, {});
    std::map<std::uint32_t, std::uint32_t> vertices;
    std::vector<std::uint32_t> kept;
    std::map<std::uint32_t, std::uint32_t> triangles;
    for (Fragment& fragment : object.fragments) {
        const auto [triangle, is_first] =
            triangles.try_emplace(fragment.triangle, static_cast<std::uint32_t>(triangles.size()));
        for (std::size_t corner = 0; is_first && corner < 3; ++corner) {
            const std::uint32_t vertex = indices[3 * std::size_t{fragment.triangle} + corner];
            const auto [known, is_new] =
                vertices.try_emplace(vertex, static_cast<std::uint32_t>(kept.size()));
            object.indices.push_back(known->second);
            if (!is_new) continue;
            kept.push_back(vertex);
            object.positions.push_back(positions[vertex]);
        }
        fragment.triangle = triangle->second;
    }
    return kept;
}

RasterObject part_of(const Pipeline& pipeline, const RasterObject& object,
                     const std::function<bool(int, int)>& is_wanted) {
    RasterObject part{{}, object.uniforms, object.indices, object.positions,
                      {}, object.width,    object.height,  object.clip_space};
    std::copy_if(object.fragments.begin(), object.fragments.end(), std::back_inserter(part.fragments),
                 [&](const Fragment& fragment) { return is_wanted(fragment.x, fragment.y); });
    part.vertices = selected(pipeline.vertex, object.vertices, drop_unseen_triangles(part));
    return part;
}

}  // namespace gobo::raster
