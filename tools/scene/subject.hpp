// The parts of required_effects(): a draw being judged, and the judges that have files of their own.
#pragma once

#include <vector>

#include "scene/effects.hpp"

namespace gobo::scene {

/// A draw being judged.
struct Subject {
    const Scene& scene;
    const Draw& draw;
    const Primitive& primitive;
    const Material& material;
    Overrides overrides;
    bool is_lit = false;  ///< some light is in
};

/// What of the material decides: its sides, holes, vertex colours, textures, the light around it, and what is
/// asked for in quality.
[[nodiscard]] std::vector<Effect> judge_surface(const Subject& subject);

/// The shadow of each light that casts any. The subject's lights must have been judged; `draws` are those of
/// the scene, with their bounds, and `lights` stand in the order of the draw's first effects.
[[nodiscard]] std::vector<Effect> judge_shadows(const Subject& subject,
                                                const std::vector<PlacedLight>& lights,
                                                const std::vector<Draw>& draws);

/// Whether holes leave nothing of the surface.
[[nodiscard]] bool is_cut_away(const Primitive& primitive, const Material& material);

}  // namespace gobo::scene
