#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/vulkan/picture.hpp"

namespace gobo::vulkan {

RenderedSelection render_selection(const Device& device, const Family& family, const Composition& composition,
                                   const std::vector<std::span<const std::uint32_t>>& modules,
                                   const std::vector<Interface>& interfaces,
                                   const std::vector<Object>& objects, const PictureOptions& options,
                                   FileSystem& files) {
    // Draws one permutation and writes its picture. The result are warnings.
    const auto render_one = [&](std::size_t i, const std::string& path) -> Result<Diagnostics> {
        const Permutation& permutation = composition.permutations[i];
        options.tell(fmt::format("it began to draw the key '{}'", key_text(family, permutation.key)));
        std::vector<RenderValue> values = family.render;
        Textures textures = options.textures;
        const std::vector<ShadowLight> shadows = shadow_lights(family, permutation.key);
        if (!shadows.empty() && options.shadow_pass != nullptr) {
            const ShadowPlan plan =
                shadow_plan(shadows, objects, options.view.camera.view(), options.shadow_pass->side);
            GOBO_TRY(const auto maps, draw_shadow_maps(device, *options.shadow_pass, plan, objects));
            textures["shadowMaps"] = depth_texels(maps);
            values.insert(values.end(), plan.values.begin(), plan.values.end());
        }
        GOBO_TRY(Picture picture, render_permutation(device, modules_of(modules, permutation), interfaces[i],
                                                     objects, values, options.view, textures));
        GOBO_TRY_DO(write_image(files, path, shrunk(picture.color, options.smooth)));
        return std::move(picture.warnings);
    };
    return draw_each(family, composition, options.folder, options.format, render_one);
}

}  // namespace gobo::vulkan
