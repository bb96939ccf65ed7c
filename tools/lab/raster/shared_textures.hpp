// The textures that pictures are drawn with: the same texels for OpenGL and for evaluation.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lab/evaluate/evaluate.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/render/texture.hpp"

namespace gobo::raster {

/// By the name of their sampler, level by level: six faces, one below the other.
using CubeMaps = std::map<std::string, std::vector<Image>>;

/// The textures of a family's samplers, deleted together. Each is filtered between its texels; those of two
/// dimensions have one level, and repeat.
class SharedTextures {
  public:
    explicit SharedTextures(const Context& context) : flat_(context), cubes_(context) {}

    /// Of each samplerCube that `cubes` names the levels, of each sampler2D for which `values` name a source
    /// the texels of that. Other samplers are left to with_plain_textures(). Errors of
    /// EnvironmentMaps::add().
    [[nodiscard]] Result<void> add(const Interface& interface, const std::vector<RenderValue>& values,
                                   const CubeMaps& cubes);

    [[nodiscard]] const GivenTextures& given() const { return given_; }
    [[nodiscard]] const evaluate::Images& images() const { return images_; }

  private:
    GlResources flat_;
    EnvironmentMaps cubes_;
    GivenTextures given_;
    evaluate::Images images_;
};

/// The depths of the lights' maps, layer by layer, read back.
[[nodiscard]] std::vector<Image> layers_of(const ShadowMaps& maps, const std::vector<ShadowLight>& lights);
/// What the sampler of the lights' maps answers: the depths of every layer, read back, as the renderer's own
/// lookups see them.
[[nodiscard]] evaluate::Image depths_of(const ShadowMaps& maps, const std::vector<ShadowLight>& lights);
[[nodiscard]] evaluate::Image depths_of(const std::vector<Image>& layers);
/// What a sampler of a cube map answers, of six faces one below the other, or of a flat picture that repeats.
/// Lookups of a cube map say their level, and two are blended.
[[nodiscard]] evaluate::Image colors_of_cube(const std::vector<Image>& levels);
[[nodiscard]] evaluate::Image colors_of_picture(const Image& picture);

}  // namespace gobo::raster
