// What the hard cases of `lit` demand of a shaded point.
#pragma once

#include <functional>
#include <string>

#include "lit_under_test.hpp"

namespace gobo {

/// A permutation at one of a case's points.
struct Trial {
    const LitUnderTest& lit;
    std::size_t permutation;
    const Inputs& inputs;
    Mode mode;
    const Shaded& shaded;
};

/// What a case demands of a trial.
struct Check {
    /// What is wrong; empty where nothing is.
    std::function<std::string(const Trial&)> fault;
    std::string tolerance;  ///< as documentation has it: "1e-05 of it", "exact"

    [[nodiscard]] std::string operator()(const Trial& trial) const { return fault(trial); }
};

/// The inputs with some of them changed.
[[nodiscard]] Inputs with(Inputs inputs, const Inputs& changes);

/// No more is asked than of every case: no undefined operation, finite, not negative.
[[nodiscard]] Check robust();
/// The same colour as with other inputs: exactly, or relative to it.
[[nodiscard]] Check same_as(const Inputs& changes, double tolerance = 0);
[[nodiscard]] Check is_color(const std::array<double, 4>& color);
/// What the same stages give in double precision, relative to it.
[[nodiscard]] Check near_double(double tolerance);
/// One of the two tones beside a cosine of k / 4, the light coming from that cosine.
[[nodiscard]] Check is_neighbouring_band();
/// The same for bands by ceil: the tones are k / 4 and (k + 1) / 4.
[[nodiscard]] Check is_neighbouring_band_of_ceil();
/// One of the two tones beside the threshold (0.25, 0.5 or 0.95) that the light's cosine is nearest to.
[[nodiscard]] Check is_neighbouring_tone();
/// Whether the fragment is there, or discarded.
[[nodiscard]] Check is_there(bool expected);
/// As sharp as the rounding of the directions lets a highlight be.
[[nodiscard]] Check is_sharp_to_rounding();
/// Each channel is finite after the conversion to a 16-bit float, and its nearest one to what double
/// precision gives without a bound, or 65504 where that is more.
[[nodiscard]] Check fits_half_float();
/// Each channel is what double precision gives, or 1 where that is more.
[[nodiscard]] Check fits_display();
/// The written depth lies in [0, 1] and on the side of the surface's own that the qualifier promises.
[[nodiscard]] Check keeps_depth_promise();

}  // namespace gobo
