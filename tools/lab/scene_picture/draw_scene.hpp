// A picture of a scene, drawn by the renderer: from where it is seen, each draw with its own permutation.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "compose/search_path.hpp"
#include "lab/render/draw_list.hpp"
#include "lab/render/driver_tasks.hpp"
#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/scene_picture/scene_objects.hpp"
#include "lab/vulkan/picture.hpp"
#include "reflect/interface.hpp"
#include "scene/effects.hpp"
#include "scene/scene_keys.hpp"
#include "validate/validate.hpp"

namespace gobo::scene {

/// From where a picture of a scene is taken, and onto what.
struct SceneView : ViewedObject {
    int width = 512;  ///< pixels
    int height = 512;
    std::array<float, 4> background = {0, 0, 0, 1};  ///< linear
};

/// The view of a camera, by its number in the file; nothing where no node of the scene holds it. Its node's
/// scale does not count (glTF 2.0 specification, 3.10.1); the picture's shape replaces the camera's own.
[[nodiscard]] std::optional<SceneView> view_of_camera(const Scene& scene, std::size_t camera, int width,
                                                      int height);

/// The number of the first camera that a node of the scene holds.
[[nodiscard]] std::optional<std::size_t> first_camera(const Scene& scene);

/// A view from `direction` (away from what is seen; not zero) that has all of the bounds in it.
[[nodiscard]] SceneView view_of_all(Box bounds, const glm::dvec3& direction, int width, int height);

/// Around all draws as they stand at rest.
[[nodiscard]] Box bounds_at_rest(const Scene& scene, const std::vector<Draw>& draws);

/// The same of all draws, wherever they move. What has no bounds does not count.
[[nodiscard]] SceneView view_of_all(const std::vector<Draw>& draws, const glm::dvec3& direction, int width,
                                    int height);

/// What stands behind a scene: what it states itself, else its fog's colour, or the colour that `gobo render`
/// has for families.
[[nodiscard]] std::array<float, 4> background_of(const Scene& scene);

/// The scene's order, and behind all others what is blended: by the distance of the middle of its bounds, the
/// farthest first.
[[nodiscard]] std::vector<std::size_t> drawing_order(const std::vector<Draw>& draws,
                                                     const SceneImages& images, const SceneView& view);

/// A scene's draws with the permutations that draw them, composed and validated.
struct SceneShaders {
    std::vector<Draw> draws;
    std::vector<std::optional<std::size_t>> permutation;  ///< one per draw; nothing: it is not drawn
    Composition composition;
    Validated validated;                ///< with the SPIR-V of every stage
    std::vector<Interface> interfaces;  ///< one per permutation
};

/// Composes and validates the key of each draw (nothing: it is not drawn), each distinct key once. Errors of
/// compose() and validate().
[[nodiscard]] Result<SceneShaders> shaders_of(const Family& family, const SearchPath& search,
                                              std::vector<Draw> draws,
                                              const std::vector<std::optional<Key>>& keys, Dialect dialect,
                                              int jobs);

/// The same, with the keys that the draws need.
[[nodiscard]] Result<SceneShaders> shaders_for_draws(const Family& family, const SearchPath& search,
                                                     std::vector<Draw> draws, const Buckets& buckets,
                                                     Dialect dialect, int jobs);

/// The objects of all draws; empty ones for draws that are not drawn.
[[nodiscard]] std::vector<Object> objects_of(const Scene& scene, const SceneShaders& shaders);

/// Whether the interface has a sampler of that name.
[[nodiscard]] bool reads(const Interface& interface, std::string_view sampler);

/// What a scene's samplers read, beside what the family's values say.
struct SceneTextures {
    const DepthPass* depth_pass = nullptr;  ///< draws shadow maps; null: nothing is in shadow
    GivenTextures given;                    ///< cube maps of the environment
};

/// A scene's programs and draws on their way to OpenGL, so that drawing alone can be timed. Holds copies of
/// the context.
class SceneDrawing {
  public:
    /// Links one program for each permutation, draws the shadow maps and uploads the objects, one per draw.
    /// `values` are those of the family; an object's own come after them. `images` is of the same draws, or
    /// empty: then nothing has holes or stands in shadow. A clock is told which permutation begins. Errors of
    /// render_permutation().
    [[nodiscard]] static Result<SceneDrawing> make(const Context& context, const SceneShaders& shaders,
                                                   const std::vector<Object>& objects,
                                                   const std::vector<RenderValue>& values,
                                                   const SceneView& view, const SceneImages& images = {},
                                                   const SceneTextures& textures = {},
                                                   DriverClock* clock = nullptr);

    /// Draws everything to the framebuffer that is bound. Where there is a clock, it is told which
    /// permutation begins, and each draw is waited for.
    void draw(DriverClock* clock = nullptr) const;
    /// Attributes, uniforms and samplers without a value, each once.
    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  private:
    explicit SceneDrawing(const Context& context) : alpha_maps_(context) {}

    /// The texture of a picture, made once for each way to look it up.
    [[nodiscard]] Texture texture_of(const Context& context, const PictureUse& use);

    std::vector<std::unique_ptr<Program>> programs_;  ///< draw lists point at them
    GlResources alpha_maps_;
    std::map<std::tuple<const TextureImage*, bool, int, int, bool, int>, Texture> pictures_;
    std::unique_ptr<ShadowMaps> shadow_maps_;
    struct List {
        std::size_t permutation;
        DrawList draws;
    };
    std::vector<List> lists_;
    std::vector<List> blended_;  ///< behind the others, the farthest from the viewer first
    Diagnostics warnings_;
};

/// The same for Vulkan.
struct VulkanSceneTextures {
    const vulkan::ShadowPass* pass = nullptr;
    vulkan::Textures given;
};

/// Draws the scene by Vulkan as draw_scene() does by OpenGL; `shaders` are of the dialect vulkan.
[[nodiscard]] Result<Picture> draw_scene_by_vulkan(const vulkan::Device& device, const Scene& scene,
                                                   const SceneShaders& shaders,
                                                   const std::vector<RenderValue>& family_values,
                                                   const SceneView& view,
                                                   const VulkanSceneTextures& textures = {},
                                                   DriverClock* clock = nullptr);

/// Whether the picture is empty since every face of every draw is turned away from the viewer, and culled.
[[nodiscard]] bool turns_all_faces_away(const Scene& scene, const std::vector<Draw>& draws,
                                        const SceneView& view);

/// Draws the scene once and reads the picture. `family_values` are the family's [render] table; blocks that a
/// scene fills take nothing from it. The parts of which a clock is told are permutations.
[[nodiscard]] Result<Picture> draw_scene(const Context& context, const Scene& scene,
                                         const SceneShaders& shaders,
                                         const std::vector<RenderValue>& family_values, const SceneView& view,
                                         const SceneTextures& textures = {}, DriverClock* clock = nullptr);

}  // namespace gobo::scene
