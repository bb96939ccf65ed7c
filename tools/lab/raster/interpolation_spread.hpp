// What a renderer's errors of interpolation make of a colour.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lab/raster/shade.hpp"

namespace gobo::raster {

/// How far each component of a varying may be from exact interpolation, in roundings. A renderer solves for
/// planes from positions in the window that are floats, and evaluates them at pixels: a rounding of a place,
/// 2^-24 of the window's width or height, moves a value by as much as it changes over that. The value itself
/// is rounded as well. renderer_precision_test measures how many.
inline constexpr double kInterpolationRoundings = 12;

/// One rounding's effect on each input of fragment_inputs(): for each component of each place, as there. Flat
/// inputs have none.
[[nodiscard]] std::map<std::string, std::vector<double>, std::less<>> interpolation_rounding(
    const Pipeline& pipeline, const RasterObject& object, const evaluate::Outputs& varyings);

/// How far each fragment's colour may be off by kInterpolationRoundings in each component of each varying:
/// the sum of what each does by itself, to first order. Steps do not count: of the two ways in which a
/// component may be off, the one that moves the colour less does.
[[nodiscard]] Result<std::vector<std::array<double, 4>>> interpolation_spread(const Pipeline& pipeline,
                                                                              const RasterObject& object);

}  // namespace gobo::raster
