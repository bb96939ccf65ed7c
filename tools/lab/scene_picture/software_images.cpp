#include "lab/scene_picture/software_images.hpp"

#include <algorithm>
#include <cmath>

#include "lab/verify/rasterise.hpp"

namespace gobo::scene {
namespace {

/// The least difference of depths that a map of 32-bit floats tells apart near 1, times the renderer's
/// `units`.
constexpr double least_offset = 4.0 / (1 << 24);

/// The largest change of depth from one texel to the next on a triangle.
double slope_of(const verify::Interpolator& triangle, double x, double y) {
    const double depth = triangle.at(x, y).depth;
    return std::max(std::abs(triangle.at(x + 1, y).depth - depth),
                    std::abs(triangle.at(x, y + 1).depth - depth));
}

void draw_depths(const ShadowCamera& camera, const Object& object, double slope, int side, double* depths) {
    const gobo::Mesh& mesh = object.mesh;
    std::vector<glm::dvec4> positions;
    for (const glm::vec3& position : mesh.positions)
        positions.push_back(camera.projection * camera.view * object.model * glm::dvec4(position, 1));
    for (const verify::Fragment& fragment : verify::rasterise(positions, mesh.indices, side, side)) {
        if (!fragment.is_covered) continue;
        if (object.culls_back_faces && fragment.is_front_facing == object.is_mirrored()) continue;
        const std::size_t first = 3 * std::size_t{fragment.triangle};
        const verify::Interpolator triangle(
            {positions[mesh.indices[first]], positions[mesh.indices[first + 1]],
             positions[mesh.indices[first + 2]]},
            side, side);
        const double x = fragment.x + 0.5;
        const double y = fragment.y + 0.5;
        const double moved =
            std::min(fragment.weights.depth + slope * slope_of(triangle, x, y) + least_offset, 1.0);
        double& nearest = depths[fragment.y * side + fragment.x];
        nearest = std::min(nearest, moved);
    }
}

double texel(const AlphaMap& map, double x, double y) {
    const auto wrapped = [](double at, int count) {
        const double inside = at - std::floor(at / count) * count;
        return static_cast<std::size_t>(std::min(inside, count - 1.0));
    };
    return map.texels[wrapped(y, map.height) * static_cast<std::size_t>(map.width) + wrapped(x, map.width)] /
           255.0;
}

/// OpenGL 4.5, 8.14.3, GL_LINEAR and GL_REPEAT.
double filtered(const AlphaMap& map, double s, double t) {
    const double u = s * map.width - 0.5;
    const double v = t * map.height - 0.5;
    const double left = std::floor(u);
    const double lower = std::floor(v);
    return std::lerp(std::lerp(texel(map, left, lower), texel(map, left + 1, lower), u - left),
                     std::lerp(texel(map, left, lower + 1), texel(map, left + 1, lower + 1), u - left),
                     v - lower);
}

}  // namespace

SoftwareImages software_images(SceneImages images, const std::vector<Object>& casters, int side,
                               double slope) {
    SoftwareImages result{std::move(images), casters, side, nullptr};
    if (result.images.lights.empty()) return result;
    const ShadowPlan plan = shadow_plan(result.images.lights, casters, glm::dmat4(1), side);
    auto maps = std::make_shared<evaluate::DepthTexels>();
    maps->width = maps->height = side;
    maps->layers = static_cast<int>(plan.cameras.size());
    const auto layer = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    maps->depths.assign(plan.cameras.size() * layer, 1.0);
    for (std::size_t i = 0; i < plan.cameras.size(); ++i)
        for (const Object& object : casters)
            draw_depths(plan.cameras[i], object, slope, side, maps->depths.data() + i * layer);
    result.maps = std::move(maps);
    return result;
}

evaluate::Image alpha_image(const AlphaMap& map) {
    return [map](const evaluate::ImageRequest& request) -> std::array<double, 4> {
        if (request.what == evaluate::ImageRequest::What::size)
            return {static_cast<double>(map.width), static_cast<double>(map.height), 1, 1};
        return {1, 1, 1, filtered(map, request.coordinates[0], request.coordinates[1])};
    };
}

}  // namespace gobo::scene
