// Which effects each draw of a scene needs, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace gobo::scene {

/// A light where a node puts it.
struct PlacedLight {
    const Light* light = nullptr;
    std::size_t node = 0;
    std::string feature;      ///< "spot": its kind, which is the feature that counts it
    std::string label;        ///< "spot 2": with its number among the scene's of that kind, from 0
    Box positions;            ///< a point, or wherever its node moves
    bool turns = false;       ///< an animation may turn it
    glm::dvec3 direction{0};  ///< unit vector along which it shines, at rest; zero: none
};

/// The lights of the scene, in the order of its nodes.
[[nodiscard]] std::vector<PlacedLight> place_lights(const Scene& scene);

/// Below these an effect is not worth a permutation. Both are half a step of an 8-bit picture by default.
struct Thresholds {
    double light = 1.0 / 512;  ///< the greatest radiance that a dropped light may send
    double fog = 1.0 / 512;    ///< the greatest share that dropped fog may hide
};

/// One effect of one draw.
struct Effect {
    std::string name;     ///< "spot 2", "fog"
    std::string feature;  ///< the feature of a family that shades it: "spot"
    std::string value;    ///< its value where the effect is in: "linear"; empty for one of a count
    bool is_in = false;
    std::string reason;
};

/// A primitive of a node.
struct Draw {
    std::size_t node = 0;
    std::size_t primitive = 0;
    std::string name;
    std::string excluded;         ///< why no family draws it ("its primitives are lines"); empty: it is drawn
    std::optional<Box> bounds;    ///< in world space, at any time; nothing: not known
    std::vector<Effect> effects;  ///< of what is drawn: every light first, in the scene's order
};

[[nodiscard]] const Primitive& primitive_of(const Scene& scene, const Draw& draw);
[[nodiscard]] const Material& material_of(const Scene& scene, const Draw& draw);
/// What is blended casts no shadow: a map holds one depth, not how much light passes.
[[nodiscard]] bool casts_shadow(const Scene& scene, const Draw& draw);
/// What the draw's material asks for, else its node, else the scene.
[[nodiscard]] Overrides overrides_of(const Scene& scene, const Draw& draw);

/// Where the eye may be: nothing where any place is possible, as when the application moves its camera.
using EyePlace = std::optional<Box>;

/// The places of all cameras of the scene, or of that one, by its number in the file; nothing where no node
/// of the scene holds any.
[[nodiscard]] EyePlace eye_of_cameras(const Scene& scene, std::optional<std::size_t> camera = {});

/// Every draw of the scene, in the order of its nodes, judged one at a time: the effects of all at once are
/// draws times lights. An effect is out only where it is certain that it cannot be seen, or only below a
/// threshold.
class SceneDraws {
  public:
    /// `scene` must outlive this.
    SceneDraws(const Scene& scene, const EyePlace& eye, const Thresholds& thresholds);

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] std::size_t size() const { return draws_.size(); }
    /// The draw with its effects.
    [[nodiscard]] Draw judged(std::size_t index) const;

  private:
    const Scene& scene_;
    EyePlace eye_;
    Thresholds thresholds_;
    std::vector<Draw> draws_;  ///< without effects
    std::vector<PlacedLight> lights_;
};

/// All of them, judged.
[[nodiscard]] std::vector<Draw> required_effects(const Scene& scene, const EyePlace& eye,
                                                 const Thresholds& thresholds);

}  // namespace gobo::scene
