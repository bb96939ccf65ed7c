// What a physically based scene looks up: its pictures, and the shipped studio around it.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include <glad/gl.h>

#include "core/diagnostic.hpp"
#include "lab/render/image.hpp"
#include "scene/scene.hpp"

namespace viewer {

/// The studio as the maps of `pbr`: the light that a white surface scatters, and level by level of roughness
/// what a surface mirrors.
struct EnvironmentMaps {
    std::vector<gobo::Image> diffuse;
    std::vector<gobo::Image> specular;
};
[[nodiscard]] gobo::Result<EnvironmentMaps> studio_maps();

/// Textures of one context, each picture once for every way to look it up.
class Textures {
  public:
    explicit Textures(const GladGLContext& gl) : gl_(gl) {}

    /// With all smaller levels; the picture must outlive this.
    [[nodiscard]] GLuint of(const gobo::scene::TextureImage& picture, const gobo::scene::TextureUse& use,
                            bool is_srgb);
    /// A cube map, level by level.
    [[nodiscard]] GLuint of(const std::vector<gobo::Image>& levels) const;

  private:
    const GladGLContext& gl_;
    std::map<std::tuple<const gobo::scene::TextureImage*, int, int, bool, int, bool>, GLuint> pictures_;
};

}  // namespace viewer
