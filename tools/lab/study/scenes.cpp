#include "lab/study/scenes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lab/raster/rasterise.hpp"
#include "lab/render/shadow_maps.hpp"

namespace gobo::study {
namespace {

Result<Mesh> mesh_of(const FileSystem& shipped, const StudyScene& scene) {
    if (scene.mesh == "sphere") return make_sphere(scene.detail, std::max(2, scene.detail / 2));
    if (scene.mesh == "torus") return make_torus(1, 0.4, scene.detail, std::max(3, scene.detail / 2));
    if (scene.mesh == "plane") return make_plane(3, scene.detail);
    return read_obj(shipped, "data/meshes/teapot.obj");
}

std::string identity_of(const std::vector<RenderValue>& values) {
    std::string text;
    for (const RenderValue& value : values)
        text += fmt::format("{}={}{};", value.name, value.source, value.numbers);
    return text;
}

/// Draws to one map's texels where the nearest surface lies.
void draw_depth(const Object& object, const ShadowCamera& camera, double* texels) {
    // As glPolygonOffset(2, ...) moves surfaces from the light: what slopes shades itself otherwise. What
    // faces the light has no slope; its depth is still not compared with itself within kShadowEdge.
    constexpr double kSlopes = 2;
    constexpr double kLeastOffset = 2e-4;
    const glm::dmat4 to_clip = camera.projection * camera.view * object.model;
    std::vector<glm::dvec4> positions;
    for (const auto& position : object.mesh.positions)
        positions.push_back(to_clip * glm::dvec4(glm::dvec3(position), 1));
    const std::vector<std::uint32_t>& indices = object.mesh.indices;
    for (const raster::Fragment& fragment : raster::rasterise(positions, indices, kShadowSide, kShadowSide)) {
        if (!fragment.is_covered) continue;
        const std::size_t corner = 3 * std::size_t{fragment.triangle};
        const raster::Interpolator triangle(
            {positions[indices[corner]], positions[indices[corner + 1]], positions[indices[corner + 2]]},
            kShadowSide, kShadowSide);
        const double x = fragment.x + 0.5;
        const double y = fragment.y + 0.5;
        const double slope = std::max(std::abs(triangle.at(x + 1, y).depth - fragment.weights.depth),
                                      std::abs(triangle.at(x, y + 1).depth - fragment.weights.depth));
        const double depth = fragment.weights.depth + (kSlopes * slope + kLeastOffset);
        double& texel = texels[static_cast<std::ptrdiff_t>(fragment.y) * kShadowSide + fragment.x];
        // Maps are floats.
        texel = std::min(texel, static_cast<double>(static_cast<float>(std::clamp(depth, 0.0, 1.0))));
    }
}

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

void DrawnScene::add_values(const std::vector<RenderValue>& more) {
    values.insert(values.end(), more.begin(), more.end());
}

Result<DrawnScene> draw_scene(const FileSystem& shipped, const Family& family, const StudyScene& scene,
                              int width, int height) {
    GOBO_TRY(Mesh mesh, mesh_of(shipped, scene));
    DrawnScene drawn;
    drawn.name = scene.name;
    drawn.objects = demo_objects(std::move(mesh));
    if (scene.floor_cells > 0)
        drawn.objects.back().mesh = make_plane(12, scene.floor_cells);
    else
        drawn.objects.pop_back();
    drawn.values = family.render;
    drawn.add_values(scene.values);
    drawn.view = {demo_camera(), width, height};
    drawn.view.camera.position = {scene.camera[0], scene.camera[1], scene.camera[2]};
    drawn.view.camera.target = {scene.target[0], scene.target[1], scene.target[2]};
    drawn.identity = fmt::format("{} {} {} {} {} {}x{} {}", scene.mesh, scene.detail, scene.floor_cells,
                                 scene.camera, scene.target, width, height, identity_of(drawn.values));
    return drawn;
}

Result<std::vector<DrawnScene>> draw_scenes(const FileSystem& shipped, const Family& family,
                                            const StudyPlan& plan) {
    std::vector<DrawnScene> scenes;
    for (const StudyScene& scene : plan.scenes) {
        GOBO_TRY(DrawnScene drawn, draw_scene(shipped, family, scene));
        scenes.push_back(std::move(drawn));
    }
    return scenes;
}

DrawnScene sphere_scene(const Family& family, int slices, int width, int height) {
    DrawnScene drawn;
    drawn.name = fmt::format("sphere of {} slices", slices);
    drawn.objects = {{make_sphere(slices, std::max(2, slices / 2)), glm::dmat4(1), {}}};
    drawn.values = family.render;
    drawn.view = {demo_camera(), width, height};
    drawn.identity = fmt::format("{} {}x{} {}", drawn.name, width, height, identity_of(drawn.values));
    return drawn;
}

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
    for (std::size_t layer = 0; layer < plan.cameras.size(); ++layer)
        for (const Object& object : scene.objects)
            draw_depth(object, plan.cameras[layer], maps.depths.data() + layer * texels);
    scene.add_values(plan.values);
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
