// Proofs held to evaluations: nothing proven impossible may be met, no number lie where none was proven to
// be.
#pragma once

#include "lab/prove/stage_proof.hpp"

namespace gobo::prove {

/// Evaluates the stage at `points` hard inputs, each on one of the variants of arithmetic in turn. Errors:
/// what contradicts the proof, once per operation; each is a fault of the prover, not of the shader.
[[nodiscard]] Diagnostics check(const evaluate::Program& program, const sanitize::InputSpace& space,
                                const std::vector<RuleAtOperation>& rules,
                                const std::vector<std::vector<Range>>& results, std::size_t points,
                                std::uint64_t seed);

}  // namespace gobo::prove
