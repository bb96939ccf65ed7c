// The shadow maps of a picture: which lights have any, from where each map is drawn, and the maps themselves.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "lab/render/draw_list.hpp"
#include "lab/render/image.hpp"

namespace gobo {

/// A light as far as its shadows are concerned, in world space.
struct ShadowLight {
    enum class Kind { directional, point, spot };
    Kind kind = Kind::directional;
    glm::dvec3 position{0};   ///< of point and spot lights
    glm::dvec3 direction{0};  ///< unit: to a directional light, along which a spot light shines
    double half_angle = 0;    ///< of a spot light's cone, radians
};

/// The lights of `lit` that cast shadows in a permutation, as the family's [render] table places them: the
/// first of each kind, as many as the features directional_shadows, spot_shadows and point_shadows count, in
/// this order: that of the block `Shadows`. Empty for families without these features.
[[nodiscard]] std::vector<ShadowLight> shadow_lights(const Family& family, const Key& key);

/// One map, in double precision: world space to the light's eye space, from there to its clip space. A point
/// light has six, in the order of OpenGL's cube maps (+x -x +y -y +z -z), each a little wider than its face,
/// by a texel at each border. Directional lights show the bounds of the objects that cast shadows, spot
/// lights their cone.
struct ShadowCamera {
    glm::dmat4 view{1};
    glm::dmat4 projection{1};
};

/// The cameras of all maps of `side` texels, layer by layer, and the values of lit's block `Shadows` that go
/// with them, for a camera whose view matrix is `view`.
struct ShadowPlan {
    std::vector<ShadowCamera> cameras;
    std::vector<RenderValue> values;
};
[[nodiscard]] ShadowPlan shadow_plan(const std::vector<ShadowLight>& lights,
                                     const std::vector<Object>& objects, const glm::dmat4& view, int side);

/// What draws shadow maps: the first of the two passes of a picture with shadows.
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

/// An object whose depth is drawn by the program that shades it, as that knows its holes. What is referred to
/// outlives it.
struct ObjectWithHoles {
    const Program& program;
    const Interface& interface;
    const Object& object;
    const std::vector<RenderValue>& values;  ///< of the program's family
    const GivenTextures& textures;
};

/// The maps of several lights as layers of one array, deleted with this object.
class ShadowMaps {
  public:
    /// A sampler2DArrayShadow's: GL_LINEAR, GL_LEQUAL.
    [[nodiscard]] Texture texture() const { return texture_; }
    /// One layer's depths, for tests.
    [[nodiscard]] Image layer(int number) const;
    /// The values of lit's block `Shadows`, one set for each light, in their order.
    [[nodiscard]] const std::vector<RenderValue>& values() const { return values_; }

  private:
    friend Result<ShadowMaps> draw_shadow_maps(const Context& context, const DepthPass& pass,
                                               const std::vector<ShadowLight>& lights,
                                               const std::vector<Object>& objects, const glm::dmat4& view,
                                               const std::vector<ObjectWithHoles>& with_holes);
    ShadowMaps(const Context& context, int side) : resources_(context), side_(side) {}
    void attach(int layer) const;

    GlResources resources_;
    int side_;
    Texture texture_;
    GLuint framebuffer_ = 0;
    std::vector<RenderValue> values_;
};

/// Draws the depth of all objects as each light sees them, those with holes by programs of their own, one
/// each in `with_holes`. `view` is the view matrix of the camera that looks the maps up. Errors as of
/// render_permutation().
[[nodiscard]] Result<ShadowMaps> draw_shadow_maps(const Context& context, const DepthPass& pass,
                                                  const std::vector<ShadowLight>& lights,
                                                  const std::vector<Object>& objects, const glm::dmat4& view,
                                                  const std::vector<ObjectWithHoles>& with_holes = {});

}  // namespace gobo
