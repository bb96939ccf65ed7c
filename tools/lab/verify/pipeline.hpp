// Both stages of a permutation joined, evaluated where nothing needs to be interpolated: at single points.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/verify/link.hpp"

namespace gobo::verify {

/// Both stages of a permutation and what joins them.
struct Pipeline {
    const evaluate::Program& vertex;
    const evaluate::Program& fragment;
    Link link;

    /// What is given to it: the vertex stage's inputs, both stages' uniforms, gl_FragCoord and the like; each
    /// name once, sorted.
    [[nodiscard]] std::vector<evaluate::Port> given() const;
};

/// By name, component by component, as evaluate::Outputs::values: the fragment stage's outputs, gl_Position,
/// and "discard", 1 where the fragment is discarded and all its outputs 0.
using PointOutputs = std::map<std::string, std::vector<double>, std::less<>>;

/// What the fragment stage is given at points, and what the vertex stage gave.
struct FragmentsAtPoints {
    evaluate::Invocations invocations;
    evaluate::Outputs vertices;
};
[[nodiscard]] Result<FragmentsAtPoints> fragments_at_points(const Pipeline& pipeline,
                                                            const evaluate::Invocations& points);

/// Runs the vertex stage in fp64, and the fragment stage on what it wrote, as at a vertex. `points` may hold
/// more than the stages read.
[[nodiscard]] Result<PointOutputs> run_at_points(const Pipeline& pipeline,
                                                 const evaluate::Invocations& points);

/// The part of `points` that a stage reads.
[[nodiscard]] evaluate::Invocations part_of(const evaluate::Program& program,
                                            const evaluate::Invocations& points);

}  // namespace gobo::verify
