// Textures of scenes for the evaluator, by the rules of OpenGL: smaller levels, wrapping, sRGB.
#pragma once

#include "lab/evaluate/evaluate.hpp"
#include "lab/render/image.hpp"
#include "lab/scene_picture/scene_objects.hpp"

namespace gobo::scene {

/// A picture of a material as SceneDrawing uploads it: the level from the gradients (OpenGL 4.5, 8.14, with
/// the longer of the two), the two nearest blended, each filtered linearly.
[[nodiscard]] evaluate::Image picture_image(const PictureUse& use);

}  // namespace gobo::scene
