// What joins a vertex stage to a fragment stage: which output each input comes from, and how it is
// interpolated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "validate/validate.hpp"
#include "lab/verify/rasterise.hpp"

namespace gobo::verify {

/// How the fragment stage reads one of its inputs.
enum class Interpolation { perspective, linear, flat };

/// A value on its way from stage to stage.
struct Varying {
    std::string output;  ///< of the vertex stage
    std::string input;   ///< of the fragment stage
    std::uint32_t components = 0;
    Interpolation interpolation = Interpolation::perspective;
};

/// Two stages joined.
struct Link {
    std::vector<Varying> varyings;
    bool needs_quads = false;  ///< derivatives, or textures that pick their level by them
    bool tests_early = false;  ///< early_fragment_tests: a written depth does not count
    bool may_discard = false;  ///< some path of the fragment stage ends without a colour
};

/// An error for a varying that the vertex stage does not write. `module` is the fragment stage's.
[[nodiscard]] Result<Link> link(const evaluate::Program& vertex, const evaluate::Program& fragment,
                                const SpirvModule& module);

/// Where the fragment stage runs: a fragment's own pixel, or its quad's.
struct FragmentPlace {
    const Fragment* fragment = nullptr;
    int x = 0;
    int y = 0;
    Weights weights;
};

/// Rasterised triangles.
struct Raster {
    std::span<const Fragment> fragments;
    std::span<const std::uint32_t> indices;
    std::span<const glm::dvec4> positions;  ///< gl_Position of each vertex
    int width = 0;
    int height = 0;
};

/// A place for each fragment; with `in_quads` four, as evaluate::Invocations wants them.
[[nodiscard]] std::vector<FragmentPlace> places_of(const Raster& raster, bool in_quads);

/// The place of a fragment's own invocation among places_of().
[[nodiscard]] std::size_t own_place(const Fragment& fragment, std::size_t index, bool in_quads);

/// What reaches a place of the values at a triangle's corners. OpenGL's last vertex is the provoking one
/// unless told otherwise.
[[nodiscard]] double interpolated(const std::array<double, 3>& corners, const Weights& weights,
                                  Interpolation interpolation);

/// gl_FragCoord at a place.
[[nodiscard]] std::array<double, 4> window_position(const FragmentPlace& place);

}  // namespace gobo::verify
