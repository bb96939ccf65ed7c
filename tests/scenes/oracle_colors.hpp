// The oracle asked what each fragment of a scene shows.
#pragma once

#include "family/family.hpp"
#include "lab/raster/shade.hpp"

namespace gobo::scene {

struct OracleColors {
    std::vector<std::array<double, 4>> colors;  ///< one per fragment
    std::size_t asked = 0;                      ///< fragments of which the oracle knows the answer
    /// The largest difference between oracle and stage, both in double precision and given the same texels,
    /// by the size of the colour or 1.
    double largest = 0;
};

/// The fragment stage is evaluated in double precision with the object's textures. What each sampler answers
/// first to a fragment is then a texture of that one colour, for which stage and oracle are asked again: a
/// fragment's colour is the stage's, corrected by what the oracle has differently. So the oracle is held to
/// real texels without looking them up itself, and where it looks up once, the colour is its own. Fragments
/// that are discarded keep the stage's.
[[nodiscard]] Result<OracleColors> oracle_colors(const Family& family, const Key& key,
                                                 const raster::Pipeline& pipeline,
                                                 const raster::RasterObject& object);

}  // namespace gobo::scene
