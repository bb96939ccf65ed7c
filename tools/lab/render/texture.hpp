// Textures for samplers that a family leaves to the renderer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "family/family.hpp"
#include "lab/render/context.hpp"
#include "lab/render/image.hpp"

namespace gobo {

/// A texture object with what it is bound to.
struct Texture {
    GLuint name = 0;
    GLenum target = GL_TEXTURE_2D;
};

/// What a texture is made of: a name that make_texture() knows, or one colour.
struct TextureSource {
    std::string name;
    std::vector<double> numbers;
};

/// What the values say last of that sampler; where they do not, what its name tells.
[[nodiscard]] TextureSource texture_source_of(const std::string& sampler,
                                              const std::vector<RenderValue>& values);

/// The texels of a texture of colours, four channels; row 0 is that at t = 0.
[[nodiscard]] Image texture_texels(const TextureSource& source);

/// Whether smaller copies stand in for a texture that is seen from afar.
enum class TextureLevels { all, one };

/// Makes a texture for a sampler type; the caller deletes it. Nothing where the renderer has none for that
/// type (it has for sampler2D, sampler2DArray, sampler3D, samplerCube, sampler2DShadow and
/// sampler2DArrayShadow).
///
/// texture_checker: squares of 0.25 and 1, eight a side. texture_white: 1. texture_ramp: from 0 to 1 along x.
/// texture_normal: the undisturbed normal (0.5, 0.5, 1). texture_lattice: opaque but for
/// one round hole. Empty with `numbers` (one to four): that colour.
/// Shadow maps hold the depth 1, so that nothing is in shadow, or `numbers`' first.
[[nodiscard]] std::optional<Texture> make_texture(const Context& context, const std::string& sampler_type,
                                                  const TextureSource& source,
                                                  TextureLevels levels = TextureLevels::all);

}  // namespace gobo
