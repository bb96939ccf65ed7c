// Textures for samplers that a family leaves to the renderer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/context.hpp"

namespace gobo {

/// A texture object with what it is bound to.
struct Texture {
    GLuint name = 0;
    GLenum target = GL_TEXTURE_2D;
};

/// Makes a texture for a sampler type; the caller deletes it. Nothing where the renderer has none for that
/// type (it has for sampler2D, sampler2DArray, sampler3D, samplerCube, sampler2DShadow and
/// sampler2DArrayShadow).
///
/// texture_checker: squares of 0.25 and 1, eight a side. texture_white: 1. texture_ramp: from 0 to 1 along x.
/// texture_normal: the undisturbed normal (0.5, 0.5, 1). Empty with `numbers` (one to four): that colour.
/// Shadow maps hold the depth 1, so that nothing is in shadow, or `numbers`' first.
[[nodiscard]] std::optional<Texture> make_texture(const Context& context, const std::string& sampler_type,
                                                  const std::string& source,
                                                  const std::vector<double>& numbers);

}  // namespace gobo
