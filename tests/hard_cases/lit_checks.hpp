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

/// What is wrong; empty where nothing is.
using Check = std::function<std::string(const Trial&)>;

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
[[nodiscard]] std::string is_neighbouring_band(const Trial& trial);
/// The same for bands by ceil: the tones are k / 4 and (k + 1) / 4.
[[nodiscard]] std::string is_neighbouring_band_of_ceil(const Trial& trial);
/// One of the two tones beside the threshold (0.25, 0.5 or 0.95) that the light's cosine is nearest to.
[[nodiscard]] std::string is_neighbouring_tone(const Trial& trial);
/// Whether the fragment is there, or discarded.
[[nodiscard]] Check is_there(bool expected);
/// As sharp as the rounding of the directions lets a highlight be.
[[nodiscard]] std::string is_sharp_to_rounding(const Trial& trial);
/// The written depth lies in [0, 1] and on the side of the surface's own that the qualifier promises.
[[nodiscard]] std::string keeps_depth_promise(const Trial& trial);

}  // namespace gobo
