// The evaluator cross-checked by a renderer: permutations drawn by both, compared pixel by pixel.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/raster/compare_picture.hpp"
#include "lab/raster/shared_textures.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/shadow_map_check.hpp"
#include "validate/validate.hpp"

namespace gobo::verify {

/// What all pictures share.
struct CrossCheckScene {
    std::vector<Object> objects;
    std::vector<RenderValue> values;  ///< the family's [render] table
    View view;
    raster::CubeMaps cubes;
    const Family* family = nullptr;           ///< of which the keys are; without it there are no shadows
    const ShadowPass* shadow_pass = nullptr;  ///< draws the shadow maps of keys that have shadows
};

struct CrossCheckReport {
    std::vector<raster::PictureReport> pictures;  ///< in the composition's order
    std::optional<ShadowMapReport> shadow_maps;   ///< of all lights that cast shadows in any key
    std::string renderer;                         ///< that drew them, with its driver
    std::vector<std::size_t> crashed;             ///< the permutations of which the driver died
};

/// Draws every permutation of the composition by OpenGL's backend, or by Vulkan where that is nothing, and
/// compares, in `jobs` child processes: a driver that crashes costs only the permutation that it was about.
/// `driver` is its name in messages. `validated` must hold the SPIR-V of every stage. Evaluation asks the
/// same textures, and the shadow maps that the renderer drew: those are compared by themselves. Errors of
/// ask_driver().
///
/// For Vulkan composition and shadow pass are of the dialect vulkan; the SPIR-V that is drawn is the one that
/// is evaluated, counts that are specialisation constants at the permutation's value.
[[nodiscard]] Result<CrossCheckReport> cross_check(const std::string& driver, std::optional<Backend> opengl,
                                                   const Composition& composition, const Validated& validated,
                                                   const CrossCheckScene& scene, int jobs);

}  // namespace gobo::verify
