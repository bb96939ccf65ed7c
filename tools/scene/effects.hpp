// What each draw of a scene calls for, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/light_reach.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

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
    int node = 0;
    int primitive = 0;
    std::string name;
    std::string excluded;         ///< why no family draws it ("its primitives are lines"); empty: it is drawn
    std::optional<Box> bounds;    ///< in world space, at any time; nothing: not known
    std::vector<Effect> effects;  ///< of what is drawn: every light first, in the scene's order
};

[[nodiscard]] const Primitive& primitive_of(const Scene& scene, const Draw& draw);
[[nodiscard]] const Material& material_of(const Scene& scene, const Draw& draw);
/// What the draw's material asks for, else its node, else the scene.
[[nodiscard]] Overrides overrides_of(const Scene& scene, const Draw& draw);

/// Where the eye may be: nothing where any place is possible, as when the application moves its camera.
using EyePlace = std::optional<Box>;

/// The places of all cameras of the scene; nothing where it has none.
[[nodiscard]] EyePlace eye_of_cameras(const Scene& scene);
/// The place of one camera, by its number in the file; nothing where no node of the scene holds it.
[[nodiscard]] EyePlace eye_of_camera(const Scene& scene, int camera);

/// Every draw of the scene, in the order of its nodes. An effect is out only where it is certain that it
/// cannot be seen, or only below a threshold.
[[nodiscard]] std::vector<Draw> required_effects(const Scene& scene, const EyePlace& eye,
                                                 const Thresholds& thresholds);

}  // namespace gobo::scene
