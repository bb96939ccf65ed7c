#include "lab/verify/on_mesh.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "lab/verify/inputs.hpp"
#include "lab/verify/stage_check.hpp"

namespace gobo::verify {
namespace {

constexpr int kSide = 16;

/// A mesh on the screen: the covered pixels, and the vertices of the triangles that cover them.
struct Drawn {
    raster::RasterObject object;
    std::vector<Sample> vertices;
    std::vector<raster::FragmentPlace> places;

    Drawn(const Sample& draw, const Mesh& mesh, bool in_quads) {
        for (const glm::vec3& position : mesh.positions)
            object.positions.push_back(draw.projection * (draw.model_view * glm::dvec4(position, 1)));
        object.indices = mesh.indices;
        object.width = object.height = kSide;
        object.fragments = raster::rasterise(object.positions, mesh.indices, kSide, kSide);
        // Beside a triangle seen edge on, which rasterisers cover to 1/256 pixel, its plane is behind the
        // eye.
        std::erase_if(object.fragments, [](const raster::Fragment& fragment) {
            return !fragment.is_covered || !(fragment.weights.inverse_w > 0);
        });
        for (const std::uint32_t vertex : raster::drop_unseen_triangles(object))
            vertices.push_back(at_vertex(draw, mesh, vertex));
        object.vertices.count = vertices.size();
        places = raster::places_of(object, in_quads);
    }

    [[nodiscard]] std::vector<double> interpolated(const std::vector<double>& at_vertices,
                                                   std::uint32_t components,
                                                   raster::Interpolation interpolation) const {
        return raster::interpolated(at_vertices, components, object, places, interpolation);
    }
};

/// Values of a varying, component by component, of all vertices or all places.
using Values = std::vector<double>;

Diagnostics unknown(const std::string& varying) {
    return fail(Fault::input, fmt::format("the oracle does not say what '{}' ought to be", varying),
                "expect it of the vertex stage (tools/lab/verify/expectation.cpp), and give samples a field "
                "for "
                "it (inputs.cpp)")
        .value();
}

std::vector<Sample> in(Precision precision, std::vector<Sample> samples) {
    return precision == Precision::fp64 ? samples : rounded_to_float(std::move(samples));
}

Values in(Precision precision, Values values) {
    if (precision == Precision::fp32)
        for (double& value : values) value = static_cast<float>(value);
    return values;
}

/// Sets a field of the samples at all places.
bool set_field(std::vector<Sample>& samples, const std::string& name, const Values& values) {
    const std::optional<Field> field = field_of(name);
    if (!field) return false;
    const std::size_t components = values.size() / samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        std::vector<double> one;
        for (std::size_t c = 0; c < components; ++c) one.push_back(values[c * samples.size() + i]);
        field->set(samples[i], one);
    }
    return true;
}

/// The draw's sample at each place, without its varyings.
std::vector<Sample> samples_at(const Sample& draw, const Drawn& drawn) {
    std::vector<Sample> samples(drawn.places.size(), draw);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].depth = drawn.places[i].weights.depth;
        samples[i].is_front_facing = drawn.places[i].fragment->is_front_facing;
    }
    return samples;
}

/// The lower half of a sphere: seen from outside and, over its rim, from inside.
Mesh make_bowl() {
    Mesh bowl = make_sphere(12, 8);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < bowl.indices.size(); i += 3) {
        const auto is_low = [&](std::size_t corner) { return bowl.positions[bowl.indices[corner]].y < 0.1F; };
        if (is_low(i) && is_low(i + 1) && is_low(i + 2))
            kept.insert(kept.end(), {bowl.indices[i], bowl.indices[i + 1], bowl.indices[i + 2]});
    }
    bowl.indices = std::move(kept);
    return bowl;
}

/// Moved to the origin and scaled so that its box reaches to 1.
Mesh fitted(Mesh mesh) {
    glm::vec3 low(mesh.positions.front());
    glm::vec3 high = low;
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const glm::vec3 half = (high - low) * 0.5F;
    const float scale = 1 / std::max({half.x, half.y, half.z});
    for (glm::vec3& position : mesh.positions) position = (position - (low + high) * 0.5F) * scale;
    return mesh;
}

}  // namespace

Result<std::vector<StageReport>> check_on_mesh(const raster::Pipeline& pipeline, const oracle::Model& model,
                                               const Mesh& mesh, std::uint64_t seed) {
    const Sample draw = make_draw(model, mesh, seed);
    const Drawn drawn(draw, mesh, pipeline.needs_quads);
    const std::vector<raster::Fragment>& fragments = drawn.object.fragments;
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < fragments.size(); ++i)
        own.push_back(raster::own_place(drawn.object, i, pipeline.needs_quads));
    StageCheck vertex(pipeline.vertex, StageKind::vertex, model, drawn.vertices.size());
    StageCheck fragment(pipeline.fragment, StageKind::fragment, model, fragments.size());
    for (const Precision precision : {Precision::fp64, Precision::fp32}) {
        if (fragments.empty()) break;  // a plane seen edge on
        const std::vector<Sample> vertices = in(precision, drawn.vertices);
        GOBO_TRY(const auto vertex_inputs, bind_inputs(pipeline.vertex, vertices));
        GOBO_TRY(const auto judged, vertex.run(precision, vertices, vertex_inputs));
        const auto& outputs = judged.outputs.values;
        std::vector<Sample> samples = samples_at(draw, drawn);
        for (const raster::Varying& varying : pipeline.varyings) {
            const auto value = outputs.find(varying.input);
            const auto expected = std::ranges::find(judged.expected, varying.input, &Expected::output);
            if (value == outputs.end() || expected == judged.expected.end())
                return tl::unexpected(unknown(varying.input));
            const auto interpolation =
                expected->is_flat ? raster::Interpolation::flat : raster::Interpolation::perspective;
            const Values values = drawn.interpolated(value->second, varying.components, interpolation);
            if (!set_field(samples, varying.input, values)) return tl::unexpected(unknown(varying.input));
        }
        samples = in(precision, std::move(samples));
        GOBO_TRY(auto inputs, bind_inputs(pipeline.fragment, samples));
        for (const raster::Varying& varying : pipeline.varyings)
            inputs.values[varying.input] =
                in(precision,
                   drawn.interpolated(outputs.at(varying.output), varying.components, varying.interpolation));
        GOBO_TRY_DO(fragment.run(precision, samples, inputs, own));
    }
    return std::vector<StageReport>{std::move(vertex).report(), std::move(fragment).report()};
}

std::vector<Mesh> test_meshes(Mesh teapot) {
    return {make_sphere(12, 8), make_torus(0.7, 0.3, 12, 8), make_plane(2, 2), make_bowl(),
            fitted(std::move(teapot))};
}

}  // namespace gobo::verify
