// The light of a whole environment: radiance by direction, as a latitude-longitude map holds it.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lab/render/image.hpp"

namespace gobo::probe {

/// A latitude-longitude map as OpenEXR's ImfEnvmap.h defines it: +y is up and in the top row, the middle of
/// the picture looks along +z, its left half along +x. Twice as wide as high; radiance linear, finite, not
/// negative.
struct Environment {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> texels;  ///< rows from the top
    int negatives = 0;               ///< channels of texels that were negative in the picture, and are 0
    double most_negative = 0;        ///< the least of them

    [[nodiscard]] const glm::dvec3& at(int column, int row) const {
        return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
};

/// The unit vector of a texel's centre.
[[nodiscard]] glm::dvec3 direction_of(const Environment& environment, int column, int row);

/// The solid angle of each texel of a row, exactly: 2 pi / width times the difference of the sines of its
/// latitudes.
[[nodiscard]] double solid_angle(const Environment& environment, int row);

/// A picture with at least three channels as an environment. Errors, at `path`: another shape than 2 : 1,
/// less than 4 x 2 texels, texels that are no numbers or infinite (negative ones, which lossy compression
/// leaves in dark places, count as 0), with the first one's place.
[[nodiscard]] Result<Environment> environment_of(const Image& image, const std::string& path);

/// The same environment with half as many texels each way, each the mean of four weighted by solid angle.
/// Width and height must be even.
[[nodiscard]] Environment halved(const Environment& environment);

}  // namespace gobo::probe
