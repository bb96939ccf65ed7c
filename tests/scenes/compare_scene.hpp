// A scene of metallic-roughness materials drawn by OpenGL and by the oracle.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene_library.hpp"

namespace gobo::scene {

/// The shipped studio, as gobo render has it: each sampler's levels.
struct Studio {
    std::map<std::string, std::vector<Image>> levels;

    [[nodiscard]] static Result<Studio> make();
};

struct Comparison {
    Image drawn;
    Image expected;
    int inside = 0;         ///< pixels whose neighbours show the same draw
    int different = 0;      ///< of them, by more than 4 of 255 steps of sRGB
    double mean = 0;        ///< difference, in steps
    std::size_t asked = 0;  ///< fragments at which the oracle was asked
    double largest = 0;     ///< difference between stage and oracle in double precision (see oracle_colors())
};

/// Both pictures, by the scene's first camera or with all of it in view. Errors of reading and drawing.
[[nodiscard]] Result<Comparison> compare_scene(const ShippedFamily& pbr, const Studio& studio,
                                               const std::string& path, int width, int height);

}  // namespace gobo::scene
