// What `gobo study` measures of a family: a TOML file of its own.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/file_system.hpp"
#include "family/family.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/render/render.hpp"

namespace gobo::study {

/// An object on a floor, seen by a camera. World coordinates, as those of [render].
struct StudyScene {
    std::string name;
    std::string mesh = "teapot";  ///< teapot, sphere, torus or plane, sized to stand on the floor
    int detail = 64;              ///< of all but the teapot: slices around, or cells along a side
    int floor_cells = 96;         ///< quads along a side of the floor; 0: there is none
    std::array<double, 3> camera = {0, 1.5, 5};
    std::array<double, 3> target = {0, -0.05, 0};
    std::vector<RenderValue> values = {};  ///< over those of [render]
};

/// A quality feature's values, measured along a uniform.
struct StudyCurve {
    std::string feature;
    std::string over;  ///< reflected name of a uniform: "Material.shininess"
    std::vector<double> numbers;
    std::string effects;  ///< key text
};

/// Two values of an effect that texts take for one another, compared as models: no error of either.
struct StudyChange {
    std::string from;  ///< key text
    std::string to;
    std::vector<RenderValue> from_values;  ///< over those of [render]
    std::vector<RenderValue> to_values;
};

struct StudyPlan {
    std::vector<std::string> effects;  ///< key texts of combinations of effects
    std::vector<std::string> quick;    ///< those that are enough for a first look
    std::vector<std::string> rate;     ///< quality features that say where, not how, light is computed
    std::vector<StudyScene> scenes;
    std::vector<StudyCurve> curves;
    std::vector<StudyChange> changes;
};

/// The plan of a TOML text, what it leaves out filled in as by default_plan(). Errors: unknown names, keys
/// that the family does not have, at their places.
[[nodiscard]] Result<StudyPlan> read_plan(std::string_view text, const std::string& path,
                                          const Family& family);

/// Up to eight combinations of effects of the family's default set, on two scenes.
[[nodiscard]] StudyPlan default_plan(const Family& family);

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
