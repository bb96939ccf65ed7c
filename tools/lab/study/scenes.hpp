// What a study draws: the scenes of a family's plan, with shadow maps that are made without a renderer.
#pragma once

#include <functional>
#include <memory>

#include "core/file_system.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/render/render.hpp"
#include "lab/study/plan.hpp"

namespace gobo::study {

/// Errors are measured at the points of a picture of this size,
inline constexpr int kSampleWidth = 96;
inline constexpr int kSampleHeight = 72;
/// and the vertices' work is spread over the fragments of one of this size.
inline constexpr int kFullWidth = 640;
inline constexpr int kFullHeight = 480;

/// A scene, ready to be drawn.
struct DrawnScene {
    std::string name;
    std::vector<Object> objects;
    std::vector<RenderValue> values;  ///< the family's, and the scene's over them
    View view;
    std::shared_ptr<const evaluate::DepthTexels> shadow_maps;  ///< see with_shadows(); null: none
    std::string identity;  ///< changes with whatever a measurement of the scene depends on

    void add_values(const std::vector<RenderValue>& more);
};

/// `shipped` holds the teapot. Errors: of reading it.
[[nodiscard]] Result<DrawnScene> draw_scene(const FileSystem& shipped, const Family& family,
                                            const StudyScene& scene, int width = kSampleWidth,
                                            int height = kSampleHeight);
/// All scenes of a plan.
[[nodiscard]] Result<std::vector<DrawnScene>> draw_scenes(const FileSystem& shipped, const Family& family,
                                                          const StudyPlan& plan);

/// A sphere of radius 1 about the origin with `slices` slices and half as many stacks, seen from the demo's
/// camera.
[[nodiscard]] DrawnScene sphere_scene(const Family& family, int slices, int width, int height);

/// Texels along each side of a shadow map.
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
