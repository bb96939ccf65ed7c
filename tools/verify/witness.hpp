// The renderer as a witness that the evaluator is honest: permutations drawn by both, pixel by pixel.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "evaluate/program.hpp"
#include "render/render.hpp"
#include "validate/validated.hpp"
#include "verify/software_picture.hpp"

namespace gobo::verify {

/// How far a pixel may be off: `absolute` plus `relative` of the expected channel.
struct PixelLimit {
    double absolute = 0;
    double relative = 0;
};

/// llvmpipe interpolates in floats: at 64 x 64 a normal's components come out within 4e-6 of exact
/// interpolation, and what is computed from them follows. Five times that for the slope of the light.
inline constexpr double kInterpolationError = 2e-5;
/// llvmpipe's pow, exp and log are approximations, up to 8e-5 of a power whose exponent is large.
inline constexpr double kPowerError = 8e-5;
/// Its inversesqrt and division are off by 1.5 ulp where the evaluator's are exact; a hundred of each.
inline constexpr double kArithmeticError = 2e-5;

/// Of a picture's pixels, at most this share may be decided differently at a discontinuity or an edge.
inline constexpr double kLargestEdgePixelShare = 0.01;

/// Root mean square over a picture's channels: what is off by kInterpolationError is so in few pixels.
inline constexpr double kRmsLimit = 1e-5;

/// A pixel with what was drawn and what should have been. Counted from the upper left.
struct WrongPixel {
    int x = 0;
    int y = 0;
    std::array<double, 4> actual{};
    std::array<double, 4> expected{};
    double ratio = 0;  ///< of the largest channel's error to its limit
};

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
    Image actual;                   ///< kept where the picture fails, or the scene keeps all
    Image expected;
    Diagnostics diagnostics;  ///< why there is no picture

    /// Wrong pixels, too many at edges, or an RMS error above its limit.
    [[nodiscard]] bool fails() const;
};

inline constexpr std::size_t kWorstPixels = 3;

/// The limit for a permutation that draws by these stages: it pays for powers only where it computes some.
[[nodiscard]] PixelLimit limit_of(const evaluate::Program& vertex, const evaluate::Program& fragment);

/// What all pictures share.
struct WitnessScene {
    std::vector<Object> objects;
    std::vector<RenderValue> values;  ///< the family's [render] table
    View view;
    const Family* family = nullptr;  ///< of which the keys are; without it there are no shadows
    /// What samplers answer, by their names; others one colour or depth.
    std::map<std::string, evaluate::Image> images;
    bool keeps_pictures = false;
};

/// Holds a picture drawn by the renderer against the evaluation of the same scene. A pixel that is out of its
/// limit is right all the same where a fragment within a rounding of covering or hiding it gives its colour,
/// or where inputs moved by at most 1e-5 do: it lies at an edge, and is counted.
[[nodiscard]] PictureReport compare_picture(const Image& drawn, const SpirvModule& vertex,
                                            const SpirvModule& fragment, const Interface& interface,
                                            const WitnessScene& scene);

/// The scene's objects as the stages see them, rasterised to its view.
[[nodiscard]] Result<std::vector<SoftwareObject>> rasterise_scene(const SoftwareProgram& program,
                                                                  const Interface& interface,
                                                                  const WitnessScene& scene);

/// Draws every permutation of the composition in the context, and compares by `jobs` threads. `validated`
/// must hold the SPIR-V of every stage. Reports are in the composition's order.
[[nodiscard]] std::vector<PictureReport> witness(const Context& context, const Composition& composition,
                                                 const Validated& validated, const WitnessScene& scene,
                                                 int jobs);

}  // namespace gobo::verify
