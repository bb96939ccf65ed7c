// A picture of a scene, drawn by the renderer: each draw with its own permutation.
#pragma once

#include <memory>

#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/scene_picture/scene_images.hpp"
#include "lab/scene_picture/scene_shaders.hpp"
#include "lab/scene_picture/scene_view.hpp"

namespace gobo::scene {

/// What a scene's samplers read, beside what the family's values say.
struct SceneTextures {
    const DepthPass* depth_pass = nullptr;  ///< draws shadow maps; null: nothing is in shadow
    GivenTextures given;                    ///< cube maps of the environment
};

/// A scene's programs and draws on their way to OpenGL, so that drawing alone can be timed. Holds copies of
/// the context.
class SceneDrawing {
  public:
    /// Draws everything to the framebuffer that is bound.
    void draw() const;
    /// Attributes, uniforms and samplers without a value, each once.
    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  private:
    friend Result<SceneDrawing> make_scene_drawing(const Context&, const SceneShaders&,
                                                   const std::vector<Object>&,
                                                   const std::vector<RenderValue>&, const SceneView&,
                                                   const SceneImages&, const SceneTextures&);
    explicit SceneDrawing(const Context& context) : alpha_maps_(context) {}

    std::vector<std::unique_ptr<Program>> programs_;  ///< draw lists point at them
    GlResources alpha_maps_;
    std::unique_ptr<ShadowMaps> shadow_maps_;
    std::vector<DrawList> lists_;
    Diagnostics warnings_;
};

/// Links one program for each permutation, draws the shadow maps and uploads the objects, one per draw.
/// `values` are those of the family; an object's own come after them. `images` is of the same draws, or
/// empty: then nothing has holes or stands in shadow. Errors of render_permutation().
[[nodiscard]] Result<SceneDrawing> make_scene_drawing(const Context& context, const SceneShaders& shaders,
                                                      const std::vector<Object>& objects,
                                                      const std::vector<RenderValue>& values,
                                                      const SceneView& view, const SceneImages& images = {},
                                                      const SceneTextures& textures = {});

/// The objects of all draws; empty ones for draws that are not drawn.
[[nodiscard]] std::vector<Object> objects_of(const Scene& scene, const SceneShaders& shaders);

/// Draws the scene once and reads the picture. `family_values` are the family's [render] table; blocks that a
/// scene fills take nothing from it.
[[nodiscard]] Result<Picture> draw_scene(const Context& context, const Scene& scene,
                                         const SceneShaders& shaders,
                                         const std::vector<RenderValue>& family_values, const SceneView& view,
                                         const SceneTextures& textures = {});

}  // namespace gobo::scene
