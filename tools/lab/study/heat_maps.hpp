// Where the error of each choice sits: pictures of it.
#pragma once

#include <string>
#include <vector>

#include "lab/render/image.hpp"
#include "lab/study/study.hpp"

namespace gobo::study {

/// The scale of the pictures' colours: logarithmic, from the least error that is told apart to the largest.
inline constexpr double kCoolest = 1e-6;
inline constexpr double kHottest = 1;

struct HeatMap {
    std::string quality;  ///< what differs from the most accurate key
    double largest = 0;   ///< error in the picture
    Image image;          ///< four channels, linear, for the eye
};

/// Each single choice of the plan's last quick effects on its first scene, 192 x 144, after a picture of the
/// scene itself (its quality is empty).
[[nodiscard]] Result<std::vector<HeatMap>> draw_heat_maps(const FileSystem& shipped, const Family& family,
                                                          const SearchPath& search, const StudyPlan& plan,
                                                          int jobs);

/// The colour of an error: dark blue through green to yellow, brighter the larger.
[[nodiscard]] std::array<double, 3> heat_color(double error);

}  // namespace gobo::study
