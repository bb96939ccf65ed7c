#include "lab/study/scene_shadows.hpp"

#include <algorithm>
#include <cmath>

#include "lab/render/shadow_maps.hpp"
#include "lab/study/study_scene.hpp"
#include "lab/verify/rasterise.hpp"

namespace gobo::study {
namespace {

/// As glPolygonOffset(2, ...) moves surfaces from the light: what slopes shades itself otherwise.
constexpr double kSlopes = 2;
/// What faces the light has no slope; its depth is still not compared with itself within kShadowEdge.
constexpr double kLeastOffset = 2e-4;

/// One map's texels: where the nearest surface lies.
class DepthLayer {
  public:
    explicit DepthLayer(double* texels) : texels_(texels) {}

    void draw(const Object& object, const ShadowCamera& camera) {
        const glm::dmat4 to_clip = camera.projection * camera.view * object.model;
        std::vector<glm::dvec4> positions;
        for (const auto& position : object.mesh.positions)
            positions.push_back(to_clip * glm::dvec4(glm::dvec3(position), 1));
        const std::vector<std::uint32_t>& indices = object.mesh.indices;
        for (const verify::Fragment& fragment :
             verify::rasterise(positions, indices, kShadowSide, kShadowSide)) {
            if (!fragment.is_covered) continue;
            const std::size_t corner = 3 * std::size_t{fragment.triangle};
            const verify::Interpolator triangle(
                {positions[indices[corner]], positions[indices[corner + 1]], positions[indices[corner + 2]]},
                kShadowSide, kShadowSide);
            put(fragment, fragment.weights.depth + offset(triangle, fragment));
        }
    }

  private:
    static double offset(const verify::Interpolator& triangle, const verify::Fragment& fragment) {
        const double x = fragment.x + 0.5;
        const double y = fragment.y + 0.5;
        const double slope = std::max(std::abs(triangle.at(x + 1, y).depth - fragment.weights.depth),
                                      std::abs(triangle.at(x, y + 1).depth - fragment.weights.depth));
        return kSlopes * slope + kLeastOffset;
    }

    void put(const verify::Fragment& fragment, double depth) {
        double& texel = texels_[static_cast<std::ptrdiff_t>(fragment.y) * kShadowSide + fragment.x];
        // Maps are floats.
        texel = std::min(texel, static_cast<double>(static_cast<float>(std::clamp(depth, 0.0, 1.0))));
    }

    double* texels_;
};

bool is_near_edge(const evaluate::DepthTexels& maps, const evaluate::ImageRequest& request) {
    evaluate::ImageRequest fetch = request;
    fetch.compares = false;
    const double left = std::floor(request.coordinates[0] * maps.width - 0.5);
    const double lower = std::floor(request.coordinates[1] * maps.height - 0.5);
    for (const double x : {left, left + 1}) {
        for (const double y : {lower, lower + 1}) {
            fetch.coordinates[0] = x;
            fetch.coordinates[1] = y;
            if (std::abs(evaluate::answer(maps, fetch)[0] - request.reference) < kShadowEdge) return true;
        }
    }
    return false;
}

}  // namespace

DrawnScene with_shadows(const Family& family, const Key& key, DrawnScene scene) {
    Family placed = family;
    // The last value of a name holds, and lights are looked up from the front.
    placed.render.assign(scene.values.rbegin(), scene.values.rend());
    const std::vector<ShadowLight> lights = shadow_lights(placed, key);
    if (lights.empty()) return scene;
    const ShadowPlan plan = shadow_plan(lights, scene.objects, scene.view.camera.view(), kShadowSide);
    evaluate::DepthTexels maps{kShadowSide, kShadowSide, static_cast<int>(plan.cameras.size()), {}};
    const std::size_t texels = std::size_t{kShadowSide} * kShadowSide;
    maps.depths.assign(texels * plan.cameras.size(), 1);
    for (std::size_t layer = 0; layer < plan.cameras.size(); ++layer) {
        DepthLayer drawn(maps.depths.data() + layer * texels);
        for (const Object& object : scene.objects) drawn.draw(object, plan.cameras[layer]);
    }
    scene.values.insert(scene.values.end(), plan.values.begin(), plan.values.end());
    scene.shadow_maps = std::make_shared<const evaluate::DepthTexels>(std::move(maps));
    return scene;
}

evaluate::Image image_of(std::shared_ptr<const evaluate::DepthTexels> maps,
                         std::function<void(std::size_t)> near_edge) {
    return [maps = std::move(maps), near_edge = std::move(near_edge)](const evaluate::ImageRequest& request) {
        if (near_edge && request.compares && is_near_edge(*maps, request)) near_edge(request.invocation);
        return evaluate::answer(*maps, request);
    };
}

}  // namespace gobo::study
