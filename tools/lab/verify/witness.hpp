// The renderer as a witness that the evaluator is honest: permutations drawn by both, pixel by pixel.
#pragma once

#include <optional>
#include <vector>

#include "compose/composition.hpp"
#include "lab/render/render.hpp"
#include "validate/validate.hpp"
#include "lab/verify/compare_picture.hpp"
#include "lab/verify/shadow_witness.hpp"
#include "lab/verify/witness_textures.hpp"

namespace gobo::verify {

/// What all pictures share.
struct WitnessScene {
    std::vector<Object> objects;
    std::vector<RenderValue> values;  ///< the family's [render] table
    View view;
    Pictures cubes;                           ///< what samplers of cube maps hold
    const Family* family = nullptr;           ///< of which the keys are; without it there are no shadows
    const ShadowPass* shadow_pass = nullptr;  ///< draws the shadow maps of keys that have shadows
};

struct WitnessReport {
    std::vector<PictureReport> pictures;         ///< in the composition's order
    std::optional<ShadowMapReport> shadow_maps;  ///< of all lights that cast shadows in any key
};

/// Draws every permutation of the composition in the context, and compares by `jobs` threads. `validated`
/// must hold the SPIR-V of every stage. Evaluation asks the same textures, and the shadow maps that the
/// renderer drew: those are compared by themselves.
[[nodiscard]] WitnessReport witness(const Context& context, const Composition& composition,
                                    const Validated& validated, const WitnessScene& scene, int jobs);

}  // namespace gobo::verify
