// Both stages of a permutation joined: which vertex output each fragment input comes from, and how it is
// interpolated.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"

namespace gobo::raster {

/// How the fragment stage reads one of its inputs.
enum class Interpolation { perspective, linear, flat };

/// A value on its way from stage to stage.
struct Varying {
    std::string output;  ///< of the vertex stage
    std::string input;   ///< of the fragment stage
    std::uint32_t components = 0;
    Interpolation interpolation = Interpolation::perspective;
};

/// Two stages, ready to be evaluated.
struct Pipeline {
    evaluate::Program vertex;
    evaluate::Program fragment;
    std::vector<Varying> varyings;
    bool needs_quads = false;  ///< derivatives, or textures that pick their level by them
    bool tests_early = false;  ///< early_fragment_tests: a written depth does not count
    bool may_discard = false;  ///< some path of the fragment stage ends without a colour
    std::string color;         ///< the output at location 0; empty where there is none
};

/// An error for a varying that the vertex stage does not write. `fragment_module` is what `fragment` was
/// decoded from.
[[nodiscard]] Result<Pipeline> join(evaluate::Program vertex, evaluate::Program fragment,
                                    std::span<const std::uint32_t> fragment_module);

/// The same from both stages' SPIR-V; errors of evaluate::decode(), too.
[[nodiscard]] Result<Pipeline> pipeline_of(std::span<const std::uint32_t> vertex,
                                           std::span<const std::uint32_t> fragment);

/// How a driver takes the derivatives that GLSL leaves to it: all but dFdxFine() and its like.
enum class Derivatives {
    fine,    ///< of each line and column of a quad by itself
    coarse,  ///< once for a quad, at its first pixel
};

/// The fragment stage with its derivatives taken so.
[[nodiscard]] std::vector<std::uint32_t> with_derivatives(std::span<const std::uint32_t> module,
                                                          Derivatives derivatives);

}  // namespace gobo::raster
