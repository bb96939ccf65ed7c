#include "lab/verify/finer.hpp"

#include <array>
#include <cmath>

#include "lab/render/mesh.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/render_feed.hpp"

namespace gobo::verify {
namespace {

constexpr int kCoarse = 8;
constexpr int kFine = 32;

/// Of colours this small a difference is rounding, however large the other difference is.
constexpr double kRounding = 1e-12;

ViewedObject view_of_sphere() {
    const Camera camera = demo_camera();
    ViewedObject view;
    view.view = camera.view();
    view.projection = camera.projection(1);
    view.viewport = {64, 64};
    return view;
}

/// What the fragment stage makes of each triangle's centre, component by component.
Result<std::vector<double>> colors(const Drawable& drawn, const Mesh& mesh,
                                   const std::vector<RenderValue>& values) {
    const Pipeline& pipeline = drawn.pipeline;
    const ViewedObject view = view_of_sphere();
    const auto plain = with_plain_textures(drawn.interface, values);
    auto vertices = uniforms_of(pipeline.vertex, drawn.interface, plain, view);
    if (!vertices) return tl::unexpected(vertices.error());
    add_attributes(pipeline.vertex, mesh, plain, *vertices);
    const auto corners = evaluate::run<double>(pipeline.vertex, *vertices);
    if (!corners) return tl::unexpected(corners.error());
    auto centres = uniforms_of(pipeline.fragment, drawn.interface, plain, view);
    if (!centres) return tl::unexpected(centres.error());
    centres->count = mesh.indices.size() / 3;
    Weights middle;
    middle.perspective = middle.linear = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (const Varying& varying : pipeline.link.varyings) {
        const std::vector<double>& from = corners->values.at(varying.output);
        std::vector<double>& to = centres->values[varying.input];
        for (std::uint32_t c = 0; c < varying.components; ++c)
            for (std::size_t i = 0; i < centres->count; ++i) {
                const double* first = &from[c * corners->count];
                const std::uint32_t* corner = &mesh.indices[3 * i];
                to.push_back(interpolated({first[corner[0]], first[corner[1]], first[corner[2]]}, middle,
                                          varying.interpolation));
            }
    }
    for (const evaluate::Port& port : pipeline.fragment.inputs)
        if (port.name == "gl_FrontFacing") centres->values[port.name] = {1};
    const auto shaded = evaluate::run<double>(pipeline.fragment, *centres);
    if (!shaded) return tl::unexpected(shaded.error());
    for (const evaluate::Port& output : pipeline.fragment.outputs)
        if (!output.name.starts_with("gl_") && output.location <= 0) return shaded->values.at(output.name);
    return std::vector<double>{};
}

Result<double> distance(const Drawable& one, const Drawable& other, const std::vector<RenderValue>& values,
                        const Mesh& mesh) {
    const auto here = colors(one, mesh, values);
    if (!here) return tl::unexpected(here.error());
    const auto there = colors(other, mesh, values);
    if (!there) return tl::unexpected(there.error());
    double sum = 0;
    for (std::size_t k = 0; k < here->size(); ++k) sum += std::pow((*here)[k] - there->at(k), 2);
    return here->empty() ? 0 : std::sqrt(sum / static_cast<double>(here->size()));
}

}  // namespace

bool Approach::holds() const {
    return fine <= std::max(kNearer * coarse, kRounding);
}

Result<Approach> approach(const Drawable& one, const Drawable& other,
                          const std::vector<RenderValue>& values) {
    Approach result;
    const Mesh fine = make_sphere(2 * kFine, kFine);
    const auto far = distance(one, other, values, make_sphere(2 * kCoarse, kCoarse));
    if (!far) return tl::unexpected(far.error());
    const auto near = distance(one, other, values, fine);
    if (!near) return tl::unexpected(near.error());
    result.coarse = *far;
    result.fine = *near;
    result.triangles = fine.indices.size() / 3;
    return result;
}

}  // namespace gobo::verify
