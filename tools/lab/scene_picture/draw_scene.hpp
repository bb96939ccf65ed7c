// A picture of a scene, drawn by the renderer: each draw with its own permutation.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "compose/search_path.hpp"
#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/scene_picture/scene_objects.hpp"
#include "lab/scene_picture/scene_view.hpp"
#include "reflect/interface.hpp"
#include "scene/scene_keys.hpp"
#include "validate/validate.hpp"

namespace gobo::scene {

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
    /// empty: then nothing has holes or stands in shadow. Errors of render_permutation().
    [[nodiscard]] static Result<SceneDrawing> make(const Context& context, const SceneShaders& shaders,
                                                   const std::vector<Object>& objects,
                                                   const std::vector<RenderValue>& values,
                                                   const SceneView& view, const SceneImages& images = {},
                                                   const SceneTextures& textures = {});

    /// Draws everything to the framebuffer that is bound.
    void draw() const;
    /// Attributes, uniforms and samplers without a value, each once.
    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  private:
    explicit SceneDrawing(const Context& context) : alpha_maps_(context) {}

    std::vector<std::unique_ptr<Program>> programs_;  ///< draw lists point at them
    GlResources alpha_maps_;
    std::unique_ptr<ShadowMaps> shadow_maps_;
    std::vector<DrawList> lists_;
    Diagnostics warnings_;
};

/// Draws the scene once and reads the picture. `family_values` are the family's [render] table; blocks that a
/// scene fills take nothing from it.
[[nodiscard]] Result<Picture> draw_scene(const Context& context, const Scene& scene,
                                         const SceneShaders& shaders,
                                         const std::vector<RenderValue>& family_values, const SceneView& view,
                                         const SceneTextures& textures = {});

}  // namespace gobo::scene
