#include "compare_scene.hpp"

#include <algorithm>
#include <cmath>

#include "lab/probe/environment.hpp"
#include "lab/raster/shared_textures.hpp"
#include "lab/render/texture.hpp"
#include "oracle_colors.hpp"
#include "scene/read_scene.hpp"
#include "software_scene.hpp"

namespace gobo::scene {
namespace {

constexpr double kSteps = 4;
constexpr int kMapSide = 512;

/// Steps of sRGB between two radiances.
double steps(float a, float b) {
    const auto signal = [](float radiance) { return srgb_of_linear(std::clamp(radiance, 0.0F, 1.0F)); };
    if (std::isnan(a) || std::isnan(b)) return 255;
    return 255 * std::abs(signal(a) - signal(b));
}

/// Pixels whose neighbours show the same draw count: at outlines a rounding may decide.
void compare(const std::vector<int>& draw, Comparison& result) {
    const int width = result.drawn.width;
    const int height = result.drawn.height;
    const auto shown = [&](int x, int y) {
        return draw[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
    };
    double sum = 0;
    for (int y = 1; y + 1 < height; ++y)
        for (int x = 1; x + 1 < width; ++x) {
            bool is_inside = shown(x, y) >= 0;
            for (int i = 0; i < 9; ++i) is_inside &= shown(x + i % 3 - 1, y + i / 3 - 1) == shown(x, y);
            if (!is_inside) continue;
            double most = 0;
            for (int c = 0; c < 3; ++c)
                most = std::max(most, steps(result.drawn.at(x, y, c), result.expected.at(x, y, c)));
            ++result.inside;
            result.different += most > kSteps ? 1 : 0;
            sum += most;
        }
    result.mean = result.inside > 0 ? sum / result.inside : 0;
}

SceneView usual_view(const Scene& scene, const std::vector<Draw>& draws, int width, int height) {
    if (const auto camera = first_camera(scene))
        if (auto view = view_of_camera(scene, *camera, width, height)) return *view;
    SceneView view = view_of_all(bounds_at_rest(scene, draws), glm::dvec3(0.5, 0.4, 1), width, height);
    view.background = background_of(scene);
    return view;
}

}  // namespace

Result<Studio> Studio::make() {
    DiskFileSystem disk;
    const std::string path = std::string(GOBO_SOURCE_DIR) + "/data/environments/studio.exr";
    GOBO_TRY(const Image image, read_image(disk, path));
    GOBO_TRY(const auto environment, probe::environment_of(image, path));
    return Studio{{{"diffuseMap", {probe::lobe_map(environment, 1, 16, 2)}},
                   {"specularMap", probe::roughness_maps(environment, 64, kRoughnessLevels, 2)}}};
}

Result<Comparison> compare_scene(const ShippedFamily& pbr, const Studio& studio, const std::string& path,
                                 int width, int height) {
    GOBO_TRY(const Scene scene, read_scene(pbr.files, path, Reading::physical));
    auto draws = required_effects(scene, eye_of_cameras(scene), {});
    const SceneView view = usual_view(scene, draws, width, height);
    GOBO_TRY(const auto shaders,
             shaders_for_draws(pbr.family, pbr.search, std::move(draws), {}, Dialect::own, 2));
    GOBO_TRY(const Context context, open_context(Backend::osmesa));
    EnvironmentMaps cubes(context);
    for (const auto& [sampler, levels] : studio.levels) GOBO_TRY_DO(cubes.add(sampler, levels));
    const DepthPass depth_pass = shipped_depth_pass(kMapSide);
    GOBO_TRY(const Picture picture,
             draw_scene(context, scene, shaders, pbr.family.render, view, {&depth_pass, cubes.textures()}));
    Comparison result;
    result.drawn = picture.color;
    GOBO_TRY(const auto programs, software_programs(shaders));
    const std::vector<Object> objects = objects_of(scene, shaders);
    SoftwareImages images = software_images(images_of(scene, shaders.draws), objects, kMapSide);
    for (const auto& [sampler, levels] : studio.levels)
        images.cubes[sampler] = raster::colors_of_cube(levels);
    images.recolored = [&](std::size_t draw, const raster::RasterObject& object,
                           std::vector<raster::Shaded>& shaded) -> Result<void> {
        const std::size_t number = *shaders.permutation[draw];
        GOBO_TRY(const auto colors, oracle_colors(pbr.family, shaders.composition.permutations[number].key,
                                                  programs[number], object));
        for (std::size_t i = 0; i < colors.colors.size(); ++i) shaded[i].color = colors.colors[i];
        result.asked += colors.asked;
        result.largest = std::max(result.largest, colors.largest);
        return {};
    };
    GOBO_TRY(const auto expected,
             draw_in_software(shaders, programs, objects, values_beside_scene(pbr.family.render), view, false,
                              images));
    result.expected = expected.color;
    compare(expected.draw, result);
    return result;
}

}  // namespace gobo::scene
