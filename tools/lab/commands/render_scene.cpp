#include "lab/commands/render_scene.hpp"

#include <fmt/format.h>

#include "lab/commands/depth_pass.hpp"
#include "lab/commands/environment.hpp"
#include "lab/render/texture.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "scene/read_scene.hpp"

namespace gobo {
namespace {

/// Slightly from above and from the side, where a scene has no camera.
const glm::dvec3 usual_direction(0.5, 0.4, 1);

/// "rooms/hall.gltf" gives "hall".
std::string stem_of(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name.substr(0, name.rfind('.'));
}

Result<scene::SceneView> view_of(const scene::Scene& scene, const std::vector<scene::Draw>& draws, int camera,
                                 const View& size) {
    const auto first = scene::first_camera(scene);
    const auto chosen = camera >= 0 ? std::optional(static_cast<std::size_t>(camera)) : first;
    if (!chosen) {
        scene::SceneView view = scene::view_of_all(draws, usual_direction, size.width, size.height);
        view.background = scene::background_of(scene);
        return view;
    }
    if (auto view = scene::view_of_camera(scene, *chosen, size.width, size.height)) return *view;
    return fail(Fault::usage,
                fmt::format("--camera: no node of '{}' holds a camera '{}'", scene.path, camera),
                fmt::format("the file has {} cameras, numbered from 0", scene.cameras.size()));
}

}  // namespace

Result<ScenePicture> render_scene(const SceneRequest& request, const World& world, const LoadedFamily& family,
                                  const Context& context, const PictureOptions& options) {
    const auto buckets = scene::parse_buckets(request.bucket_lights);
    if (!buckets) return tl::unexpected(buckets.error());
    const Result<scene::Scene> scene = scene::read_scene(world.disk, request.path);
    if (!scene) return tl::unexpected(scene.error());
    auto draws = scene::required_effects(*scene, scene::eye_of_cameras(*scene), {});
    const auto view = view_of(*scene, draws, request.camera, options.view);
    if (!view) return tl::unexpected(view.error());
    const auto shaders = scene::shaders_for_draws(family.family, family.search, std::move(draws), *buckets,
                                                  request.dialect, request.common.jobs);
    if (!shaders) return tl::unexpected(shaders.error());
    DepthPass depth_pass;
    scene::SceneTextures textures;
    if (has_shadows(family.family, shaders->composition)) {
        auto loaded = load_depth_pass(world, request.common);
        if (!loaded) return tl::unexpected(loaded.error());
        depth_pass = std::move(*loaded);
        textures.depth_pass = &depth_pass;
    }
    CubeMaps cubes(context);
    if (const auto added =
            add_environment(world, request.environment, request.common.jobs, shaders->interfaces, cubes);
        !added)
        return tl::unexpected(added.error());
    textures.given = cubes.textures();
    const auto picture = scene::draw_scene(context, *scene, *shaders, family.family.render, *view, textures);
    if (!picture) return tl::unexpected(picture.error());
    // Holes are cut, nothing is blended: what was drawn is opaque, whatever alpha its vertices have.
    Image opaque = picture->color;
    for (std::size_t i = 3; i < opaque.values.size(); i += 4) opaque.values[i] = 1;
    const std::string file =
        fmt::format("{}/{}.{}", options.folder, stem_of(request.path), name_of(options.format));
    if (const auto written = write_image(world.disk, file, shrunk(opaque, options.smooth)); !written)
        return tl::unexpected(written.error());
    return ScenePicture{file, picture->warnings};
}

}  // namespace gobo
