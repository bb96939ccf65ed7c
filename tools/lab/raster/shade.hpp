// The fragments of a rasterised object shaded: both stages evaluated, with inputs as they are or moved a
// little; and what a renderer's errors of interpolation and arithmetic make of their colours.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lab/raster/raster_object.hpp"

namespace gobo::raster {

/// Where the fragment stage runs for a fragment: at its own pixel, or at those of its quad.
struct FragmentPlace {
    const Fragment* fragment = nullptr;
    int x = 0;
    int y = 0;
    Weights weights;

    double window_y = 0;  ///< of gl_FragCoord

    /// gl_FragCoord.
    [[nodiscard]] std::array<double, 4> window_position() const {
        return {x + 0.5, window_y, weights.depth, weights.inverse_w};
    }
};

/// A place for each fragment; with `in_quads` four, as evaluate::Invocations wants them.
[[nodiscard]] std::vector<FragmentPlace> places_of(const RasterObject& object, bool in_quads);

/// The place of a fragment's own pixel, by its number in the object, among places_of().
[[nodiscard]] std::size_t own_place(const RasterObject& object, std::size_t index, bool in_quads);

/// What reaches the places of so many components of a vertex output. OpenGL's last vertex is the provoking
/// one unless told otherwise.
[[nodiscard]] std::vector<double> interpolated(const std::vector<double>& at_vertices,
                                               std::uint32_t components, const RasterObject& object,
                                               const std::vector<FragmentPlace>& places,
                                               Interpolation interpolation);

/// The fragment stage's inputs and uniforms, one invocation for each place, interpolated from the vertex
/// stage's outputs.
[[nodiscard]] evaluate::Invocations fragment_inputs(const Pipeline& pipeline, const RasterObject& object,
                                                    const std::vector<FragmentPlace>& places,
                                                    const evaluate::Outputs& outputs);

/// fragment_inputs() of the fragments alone, never in quads, and with the vertex stage in fp64.
[[nodiscard]] Result<evaluate::Invocations> exact_fragment_inputs(const Pipeline& pipeline,
                                                                  const RasterObject& object);

/// What the fragment stage made of a fragment.
struct Shaded {
    std::array<double, 4> color = {0, 0, 0, 1};  ///< without colour outputs the depth stands for red
    double depth = 0;
    bool is_discarded = false;
};

/// The operations executed, by kind: by all vertices together, by all fragments, and by the other pixels of
/// their quads.
struct Work {
    evaluate::Counts vertices{};
    evaluate::Counts fragments{};
    evaluate::Counts helpers{};
};

/// How attributes and varyings are moved, to see what hangs on a rounding: each component at random by up to
/// `by` of the largest component of its vector. Coverage stays.
struct Nudge {
    double by = 0;
    std::uint64_t seed = 0;
};

/// Shades every fragment of the object, both stages in arithmetic of T. Adds to `work` unless it is null.
template <class T>
[[nodiscard]] Result<std::vector<Shaded>> shade(const Pipeline& pipeline, const RasterObject& object,
                                                Work* work = nullptr, const Nudge& nudge = {});

/// How far each component of a varying may be from exact interpolation, in roundings. A renderer solves for
/// planes from positions in the window that are floats, and evaluates them at pixels: a rounding of a place,
/// 2^-24 of the window's width or height, moves a value by as much as it changes over that. The value itself
/// is rounded as well. renderer_precision_test measures how many.
inline constexpr double kInterpolationRoundings = 12;

/// One rounding's effect on each input of fragment_inputs(): for each component of each place, as there. Flat
/// inputs have none.
[[nodiscard]] std::map<std::string, std::vector<double>, std::less<>> interpolation_rounding(
    const Pipeline& pipeline, const RasterObject& object, const evaluate::Outputs& varyings);

/// How far each fragment's colour may be off by kInterpolationRoundings in each component of each varying,
/// and by divisions, roots and powers off by what Vulkan allows them, all one way: the sum of what each does
/// by itself, to first order. Where a formula cancels, as the plain GGX peak does, that is much. Steps do not
/// count: of the two ways in which something may be off, the one that moves the colour less does. Where there
/// are derivatives, neighbours in a quad may be off the opposite ways as well as the same.
[[nodiscard]] Result<std::vector<std::array<double, 4>>> color_spread(const Pipeline& pipeline,
                                                                      const RasterObject& object);

}  // namespace gobo::raster
