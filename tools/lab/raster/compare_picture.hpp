// One picture of a renderer held against its evaluation, pixel by pixel.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/bytes.hpp"
#include "family/family.hpp"
#include "lab/raster/raster_object.hpp"
#include "lab/render/image.hpp"
#include "lab/render/render.hpp"

namespace gobo::raster {

/// How far a pixel may be off: `absolute`, plus `relative` of the expected channel, plus what the errors of
/// interpolation and arithmetic make of it (color_spread()).
struct PixelLimit {
    double absolute = 0;
    double relative = 0;
};

/// Of powers and exponentials below a thousandth, llvmpipe's approximations leave more of themselves wrong:
/// so much of a light whose colour is about 1.
inline constexpr double kSmallestError = 1e-6;
/// llvmpipe's pow, exp and log are approximations, off by up to 8e-5 of a power whose exponent is large (1e-5
/// at 90), and so is its atan (2e-5).
inline constexpr double kPowerError = 8e-5;
/// Its inversesqrt and division are off by 1.5 ulp where the evaluator's are exact; a hundred of each.
inline constexpr double kArithmeticError = 2e-5;
/// Its filter's weights are floats of a place that is a coordinate times the number of texels, on a cube
/// after a division: off by up to 1.4e-6 of the contrast between two texels, which here is 1.
inline constexpr double kFilteringError = 2e-6;

/// Of a picture's pixels, at most this share may be decided differently at a discontinuity or an edge.
inline constexpr double kLargestEdgePixelShare = 0.01;

/// Root mean square over a picture's channels, of the errors beyond their spread; of a value above 1, the
/// relative error. What is off by much is so in few pixels.
inline constexpr double kRmsLimit = 1e-5;

/// A pixel with what was drawn and what should have been. Counted from the upper left.
struct WrongPixel {
    int x = 0;
    int y = 0;
    std::array<double, 4> actual{};
    std::array<double, 4> expected{};
    double ratio = 0;  ///< of the largest channel's error to its limit
};

void fields(auto& archive, OneOf<WrongPixel> auto& value) {
    auto& [x, y, actual, expected, ratio] = value;
    archive(x, y, ratio);
    for (std::size_t i = 0; i < actual.size(); ++i) archive(actual[i], expected[i]);
}

/// One permutation's picture.
struct PictureReport {
    Key key;
    double largest_error = 0;  ///< over the channels of all pixels but those at an edge
    double root_mean_square = 0;
    double largest_ratio = 0;  ///< of an error to its limit
    std::size_t pixels = 0;
    std::size_t drawn = 0;  ///< pixels that are not background
    std::size_t edges = 0;  ///< right, but decided differently at a discontinuity or a triangle's edge
    std::size_t wrong = 0;
    std::vector<WrongPixel> worst;  ///< at most kWorstPixels, largest ratio first
    Image actual;                   ///< kept where the picture fails, or all are
    Image expected;
    Diagnostics diagnostics;  ///< why there is no picture
    Diagnostics warnings;     ///< of what was drawn: attributes, uniforms and samplers without a value

    /// Wrong pixels, too many at edges, or an RMS error above its limit.
    [[nodiscard]] bool fails() const;
};
GOBO_FIELDS(PictureReport, key, largest_error, root_mean_square, largest_ratio, pixels, drawn, edges, wrong,
            worst, actual, expected, diagnostics, warnings)

inline constexpr std::size_t kWorstPixels = 3;

/// Which reports hold their pictures.
enum class KeptPictures { failing, all };

/// Holds a picture drawn by the renderer against the evaluation of the same objects. A pixel that is out of
/// its limit is right all the same where a fragment within a rounding of covering or hiding it gives its
/// colour, or where inputs moved by at most 1e-5 do: it lies at an edge, and is counted. Of stages that write
/// no colour the depths are compared.
[[nodiscard]] PictureReport compare_picture(const Picture& drawn, const Pipeline& pipeline,
                                            const std::vector<RasterObject>& objects,
                                            const std::array<float, 4>& background,
                                            KeptPictures kept = KeptPictures::failing);

}  // namespace gobo::raster
