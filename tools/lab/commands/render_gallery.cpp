#include "lab/commands/render_gallery.hpp"

#include "lab/commands/depth_pass.hpp"
#include "lab/commands/study_files.hpp"
#include "lab/gallery/gallery.hpp"

namespace gobo {
namespace {

/// Texels along each side of a shadow map: as fine as the pictures are, a quarter of the work of others.
constexpr int kShadowSide = 512;

}  // namespace

Result<RenderedSelection> render_gallery(const World& world, const CommonOptions& options,
                                         const Family& family, const Composition& composition,
                                         const Validated& validated, GallerySetting setting) {
    gallery::Scene scene;
    scene.objects = demo_objects(std::move(setting.mesh));
    scene.view = setting.view;
    scene.cube_maps = std::move(setting.environment);
    if (has_shadows(family, composition)) {
        auto depth_pass = load_depth_pass(world, options);
        if (!depth_pass) return tl::unexpected(depth_pass.error());
        scene.depth_pass = std::move(*depth_pass);
        scene.depth_pass.side = kShadowSide;
    }
    gallery::GalleryOptions gallery_options;
    gallery_options.folder = setting.folder;
    gallery_options.backend = setting.backend;
    gallery_options.jobs = options.jobs;
    auto weights = load_weights(world, "");
    if (!weights) return tl::unexpected(weights.error());
    gallery_options.weights = std::move(*weights);
    return gallery::make_gallery(scene, family, composition, validated, gallery_options, world.disk,
                                 world.shipped);
}

}  // namespace gobo
