// Pictures made fit for the eye: many lights together are brighter than a display.
#pragma once

#include "lab/render/image.hpp"

namespace gobo::gallery {

/// The factor that brings all but the brightest hundredth of the picture's pixels below a display's white; 1
/// for a picture that is darker.
[[nodiscard]] float exposure_of(const Image& picture);

/// The picture's colours times `exposure`; a fourth channel stays.
[[nodiscard]] Image exposed(Image picture, float exposure);

}  // namespace gobo::gallery
