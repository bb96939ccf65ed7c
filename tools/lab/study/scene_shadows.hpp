// The shadow maps of a scene, made without a renderer.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lab/evaluate/images.hpp"
#include "family/key.hpp"
#include "lab/render/render.hpp"

namespace gobo::study {

struct DrawnScene;

/// Texels along each side of a map.
inline constexpr int kShadowSide = 256;

/// A comparison this near to the depth that it is compared with may go either way.
inline constexpr double kShadowEdge = 1e-5;

/// The scene with the values of lit's block `Shadows` and its maps, as far as lights of the key cast shadows:
/// otherwise as it was. The lights stand where the scene's values place them.
[[nodiscard]] DrawnScene with_shadows(const Family& family, const Key& key, DrawnScene scene);

/// The maps as the image of a sampler. `near_edge`, where given, is called with each invocation that compares
/// a depth within kShadowEdge of one of the four texels that a filter may ask for.
[[nodiscard]] evaluate::Image image_of(std::shared_ptr<const evaluate::DepthTexels> maps,
                                       std::function<void(std::size_t)> near_edge = {});

}  // namespace gobo::study
