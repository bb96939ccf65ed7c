// The shadow maps of a stage, whose lights and meshes stand still.
#pragma once

#include <functional>
#include <vector>

#include <glad/gl.h>

#include "lab/render/shadow_maps.hpp"
#include "settings.hpp"
#include "stage.hpp"

namespace viewer {

class Shadows {
  public:
    Shadows(const GladGLContext& gl, const Stage& stage);

    /// Draws the maps when first called: `draw_all` draws every mesh as the light's camera sees it.
    void draw(const std::function<void(const gobo::ShadowCamera&)>& draw_all);
    /// A sampler2DArrayShadow's; 0 where no light casts any shadow.
    [[nodiscard]] GLuint texture() const { return texture_; }
    /// What a draw's lights look their maps up with: those that the settings leave. `lit` and `pbr` share the
    /// block.
    [[nodiscard]] lit::Shadows block(const StageDraw& draw, const Settings& settings,
                                     const glm::dmat4& view) const;

  private:
    const GladGLContext& gl_;
    const Stage& stage_;
    gobo::ShadowPlan plan_;  ///< from world space
    GLuint texture_ = 0;
};

}  // namespace viewer
