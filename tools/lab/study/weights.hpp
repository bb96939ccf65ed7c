// What an operation of each kind costs on a renderer.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/study/measure.hpp"

namespace gobo::study {

/// A number for each kind of operation.
using ByKind = std::array<double, evaluate::kKinds>;

/// Weights of one renderer. The unit is one addition of floats.
struct Weights {
    std::string renderer;    ///< GL_RENDERER
    double nanoseconds = 0;  ///< of one unit, for one invocation
    ByKind by_kind{};
};

/// Columns renderer, kind, weight, nanoseconds. Errors: a missing column or kind, a number that is none; at
/// `path` and the line.
[[nodiscard]] Result<std::vector<Weights>> read_weights(std::string_view csv, const std::string& path);
[[nodiscard]] std::string weights_csv(const std::vector<Weights>& weights);

/// The operations of one fragment, of one vertex, and of a fragment with its part of the vertices, in the
/// weights' unit.
struct Costs {
    double fragment = 0;
    double vertex = 0;
    double vertices_per_fragment = 0;  ///< in a picture of kFullWidth x kFullHeight
    double total = 0;
};

[[nodiscard]] Costs costs_of(const Measurement& measurement, const Weights& weights);

[[nodiscard]] double weighted(const evaluate::Counts& counts, const Weights& weights);

}  // namespace gobo::study
