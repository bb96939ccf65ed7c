// gobo render of a whole selection: its pictures with errors and costs, on one page.
#pragma once

#include "lab/commands/environment.hpp"
#include "lab/render/context.hpp"
#include "lab/render/render.hpp"
#include "validate/validate.hpp"

namespace gobo {

/// What a gallery shows its permutations with.
struct GallerySetting {
    Mesh mesh;
    View view;
    std::string folder;
    Backend backend = Backend::osmesa;
    CubeImages environment;  ///< empty where no key looks any up
};

/// Draws and evaluates every permutation. `validated` must hold the SPIR-V of every stage.
[[nodiscard]] Result<RenderedSelection> render_gallery(const World& world, const CommonOptions& options,
                                                       const Family& family, const Composition& composition,
                                                       const Validated& validated, GallerySetting setting);

}  // namespace gobo
