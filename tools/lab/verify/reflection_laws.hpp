// What physics asks of a metallic-roughness surface, whatever its models: tried on the shaders themselves.
#pragma once

#include <cstdint>

#include "core/diagnostic.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/oracle/model.hpp"
#include "lab/verify/report.hpp"

namespace gobo::verify {

/// Points at which each law is tried.
inline constexpr int kLawPoints = 64;

/// Evaluates the fragment stage of a key of `pbr` in fp64, where the key has what a law speaks of:
/// - furnace: in a world of radiance 1 no more than 1 leaves the surface, and no less than 0;
/// - white furnace: with what is mirrored twice given back, exactly 1 leaves a white one;
/// - reciprocity: light and viewer may change places, f(l, v) = f(v, l);
/// - mirror image: a mirrored world looks the same;
/// - metal: what a dielectric would reflect makes no difference to it.
/// A failure's output names the law. Errors: of evaluation.
[[nodiscard]] Result<StageReport> check_laws(const evaluate::Program& program, const oracle::Model& model,
                                             std::uint64_t seed);

}  // namespace gobo::verify
