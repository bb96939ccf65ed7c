// Shadow maps drawn by a depth pass: the first of the two passes of a picture with shadows.
#pragma once

#include <vector>

#include "lab/render/image.hpp"
#include "lab/render/shadow_camera.hpp"
#include "lab/render/stage_text.hpp"

namespace gobo {

/// What the depth pass draws with.
struct DepthPass {
    std::vector<StageText> stages;
    Interface interface;
    std::vector<RenderValue> values;  ///< its family's [render] table
    int side = 1024;                  ///< texels along each side of a map
    /// glPolygonOffset: a surface is moved away from the light by `slope` times its depth's largest slope
    /// over a texel, plus `units` times the least difference of depths. 2 and 4: a slope of 1 covers half a
    /// texel to either side of its centre and the filter reaches one further; see docs/shadows.md for what it
    /// costs.
    double slope = 2;
    double units = 4;
};

/// The maps of several lights as layers of one array, deleted with this object.
class ShadowMaps {
  public:
    ShadowMaps(ShadowMaps&& other) noexcept;
    ShadowMaps& operator=(ShadowMaps&&) = delete;
    ~ShadowMaps();

    /// A sampler2DArrayShadow's: GL_LINEAR, GL_LEQUAL.
    [[nodiscard]] Texture texture() const { return texture_; }
    /// One layer's depths, for tests.
    [[nodiscard]] Image layer(int number) const;
    /// The values of lit's block `Shadows`, one set for each light, in their order.
    [[nodiscard]] const std::vector<RenderValue>& values() const { return values_; }

  private:
    friend Result<ShadowMaps> draw_shadow_maps(const Context& context, const DepthPass& pass,
                                               const std::vector<ShadowLight>& lights,
                                               const std::vector<Object>& objects, const glm::dmat4& view);
    ShadowMaps(const Context& context, int side) : context_(context), side_(side) {}
    void attach(int layer) const;

    Context context_;
    int side_;
    Texture texture_;
    GLuint framebuffer_ = 0;
    std::vector<RenderValue> values_;
};

/// Draws the depth of all objects as each light sees them. `view` is the view matrix of the camera that looks
/// the maps up. Errors as of render_permutation().
[[nodiscard]] Result<ShadowMaps> draw_shadow_maps(const Context& context, const DepthPass& pass,
                                                  const std::vector<ShadowLight>& lights,
                                                  const std::vector<Object>& objects, const glm::dmat4& view);

}  // namespace gobo
