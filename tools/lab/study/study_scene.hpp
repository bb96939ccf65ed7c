// What a study draws: the scenes of a family's plan.
#pragma once

#include <memory>
#include <string>
#include <vector>

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
};

/// `shipped` holds the teapot. Errors: of reading it.
[[nodiscard]] Result<DrawnScene> draw_scene(const FileSystem& shipped, const Family& family,
                                            const StudyScene& scene, int width = kSampleWidth,
                                            int height = kSampleHeight);

/// A sphere of radius 1 about the origin with `slices` slices and half as many stacks, seen from the demo's
/// camera.
[[nodiscard]] DrawnScene sphere_scene(const Family& family, int slices, int width, int height);

/// The values in one line, for identities.
[[nodiscard]] std::string identity_of(const std::vector<RenderValue>& values);

}  // namespace gobo::study
