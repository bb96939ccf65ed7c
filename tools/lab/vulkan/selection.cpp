#include "lab/vulkan/picture.hpp"

namespace gobo::vulkan {
namespace {

class VulkanRenderer final : public KeyRenderer {
  public:
    VulkanRenderer(const Device& device, const DrawnSelection& selection,
                   const std::vector<std::span<const std::uint32_t>>& modules, const Textures& textures,
                   const ShadowPass* pass)
        : device_(device), selection_(selection), modules_(modules), textures_(textures), pass_(pass) {}

    [[nodiscard]] std::string name() const override { return device_.name(); }

    [[nodiscard]] Result<Picture> draw(std::size_t permutation) override {
        const Permutation& drawn = selection_.composition.permutations[permutation];
        std::vector<RenderValue> values = selection_.family.render;
        Textures textures = textures_;
        const std::vector<ShadowLight> shadows = shadow_lights(selection_.family, drawn.key);
        if (!shadows.empty() && pass_ != nullptr) {
            const ShadowPlan plan =
                shadow_plan(shadows, selection_.objects, selection_.view.camera.view(), pass_->side);
            GOBO_TRY(const auto maps, draw_shadow_maps(device_, *pass_, plan, selection_.objects));
            textures["shadowMaps"] = depth_texels(maps);
            values.insert(values.end(), plan.values.begin(), plan.values.end());
        }
        return render_permutation(device_, modules_of(modules_, drawn), selection_.interfaces[permutation],
                                  selection_.objects, values, selection_.view, textures);
    }

  private:
    Device device_;
    DrawnSelection selection_;
    std::vector<std::span<const std::uint32_t>> modules_;
    Textures textures_;
    const ShadowPass* pass_;
};

}  // namespace

std::unique_ptr<KeyRenderer> vulkan_renderer(const Device& device, const DrawnSelection& selection,
                                             const std::vector<std::span<const std::uint32_t>>& modules,
                                             const Textures& textures, const ShadowPass* pass) {
    return std::make_unique<VulkanRenderer>(device, selection, modules, textures, pass);
}

}  // namespace gobo::vulkan
