// Scenes of others drawn by OpenGL and by the oracle: two pictures of each, and a line of a table.
//
// usage: compare_models FOLDER WIDTHxHEIGHT FILE...
// Into FOLDER go N.drawn.png and N.oracle.png for the N-th file, from 0. A line: N, pixels inside draws,
// those of them that differ by more than 4 of 255 steps of sRGB, the mean difference in steps, the fragments
// that the oracle was asked about, and the stage's largest difference from it, tab-separated.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "lab/probe/environment.hpp"
#include "lab/render/texture.hpp"
#include "oracle_colors.hpp"
#include "scene/read_scene.hpp"
#include "scene_library.hpp"
#include "software_scene.hpp"
#include "software_textures.hpp"

namespace gobo::scene {
namespace {

constexpr double kSteps = 4;
constexpr int kMapSide = 512;

/// The shipped studio, as gobo render has it.
struct Studio {
    std::map<std::string, std::vector<Image>> levels;

    static Result<Studio> make() {
        DiskFileSystem disk;
        const std::string path = std::string(GOBO_SOURCE_DIR) + "/data/environments/studio.exr";
        GOBO_TRY(const Image image, read_image(disk, path));
        GOBO_TRY(const auto environment, probe::environment_of(image, path));
        return Studio{{{"diffuseMap", {probe::lobe_map(environment, 1, 16, 2)}},
                       {"specularMap", probe::roughness_maps(environment, 64, kRoughnessLevels, 2)}}};
    }
};

struct Comparison {
    Image drawn;
    Image expected;
    int inside = 0;
    int different = 0;
    double mean = 0;
    std::size_t asked = 0;
    double largest = 0;
};

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

Result<Comparison> compare_scene(const ShippedFamily& pbr, const Studio& studio, const std::string& path,
                                 int width, int height) {
    GOBO_TRY(const Scene scene, read_scene(pbr.files, path, Reading::physical));
    auto draws = required_effects(scene, eye_of_cameras(scene), {});
    const SceneView view = usual_view(scene, draws, width, height);
    GOBO_TRY(const auto shaders,
             shaders_for_draws(pbr.family, pbr.search, std::move(draws), {}, Dialect::own, 2));
    GOBO_TRY(const Context context, open_context(Backend::osmesa));
    CubeMaps cubes(context);
    for (const auto& [sampler, levels] : studio.levels) GOBO_TRY_DO(cubes.add(sampler, levels));
    const DepthPass depth_pass = shipped_depth_pass(kMapSide);
    GOBO_TRY(const Picture picture,
             draw_scene(context, scene, shaders, pbr.family.render, view, {&depth_pass, cubes.textures()}));
    Comparison result;
    result.drawn = picture.color;
    GOBO_TRY(const auto programs, software_programs(shaders));
    const std::vector<Object> objects = objects_of(scene, shaders);
    SoftwareImages images = software_images(images_of(scene, shaders.draws), objects, kMapSide);
    for (const auto& [sampler, levels] : studio.levels) images.cubes[sampler] = cube_image(levels);
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

Result<void> write_pictures(const std::string& stem, Comparison comparison) {
    DiskFileSystem disk;
    for (Image* image : {&comparison.drawn, &comparison.expected})
        for (std::size_t i = 3; i < image->values.size(); i += 4) image->values[i] = 1;
    GOBO_TRY_DO(write_image(disk, stem + ".drawn.png", comparison.drawn));
    GOBO_TRY_DO(write_image(disk, stem + ".oracle.png", comparison.expected));
    return {};
}

int run(const std::vector<std::string>& arguments) {
    int width = 0;
    int height = 0;
    if (arguments.size() < 3 || std::sscanf(arguments[1].c_str(), "%dx%d", &width, &height) != 2) {
        fmt::print(stderr, "usage: compare_models FOLDER WIDTHxHEIGHT FILE...\n");
        return 2;
    }
    const ShippedFamily pbr("pbr");
    const auto studio = Studio::make();
    if (!studio) {
        fmt::print(stderr, "{}", text_of(studio.error()));
        return 3;
    }
    int status = 0;
    for (std::size_t i = 2; i < arguments.size(); ++i) {
        auto comparison = compare_scene(pbr, *studio, arguments[i], width, height);
        const auto written = comparison
                                 ? write_pictures(fmt::format("{}/{}", arguments[0], i - 2), *comparison)
                                 : Result<void>(tl::unexpected(comparison.error()));
        if (!written) {
            fmt::print(stderr, "{}", text_of(written.error()));
            status = 1;
            continue;
        }
        fmt::print("{}\t{}\t{}\t{:.3f}\t{}\t{:.2g}\n", i - 2, comparison->inside, comparison->different,
                   comparison->mean, comparison->asked, comparison->largest);
        static_cast<void>(std::fflush(stdout));
    }
    return status;
}

}  // namespace
}  // namespace gobo::scene

int main(int count, char** arguments) {
    // llvmpipe filters by weights of 8 bits, with one level for four pixels, unless told otherwise.
    setenv("GALLIVM_PERF", "no_aos_sampling,no_quad_lod", 1);
    return gobo::scene::run({arguments + 1, arguments + count});
}
