// The hard cases of `lit` as a table: which keys they concern, the inputs, and what is demanded there.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hard_case_index.hpp"
#include "lit_checks.hpp"

namespace gobo {

struct Case {
    std::string name;  ///< what is tried: "zero_normal"
    /// The names of its hard cases (hard_case_index.hpp), or the title of a model (docs/models.toml).
    std::vector<std::string> about;
    std::string where;  ///< the keys it concerns
    std::vector<Inputs> points;
    Check check;
    std::vector<std::string> features = {"directional", "point", "spot",         "diffuse",
                                         "specular",    "fog",   "fog_distance", "shading"};
    std::string family = "lit";
};

/// For messages of tests.
inline void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.name;
}

[[nodiscard]] const std::vector<Case>& lit_cases();
[[nodiscard]] bool is_about(const Case& tested, const HardCase& hard);

/// The part of them that is about models: flattened ones, and ones that are much longer than wide.
[[nodiscard]] std::vector<Case> model_cases();

/// The part of them that is about the surface's own models: tones, sides, tables of materials, holes,
/// colours, and the light around it.
[[nodiscard]] std::vector<Case> surface_cases();

/// Something wrong with a permutation at one of a case's points.
struct CaseFault {
    std::string key;
    std::size_t permutation = 0;  ///< index in LitUnderTest
    std::size_t point = 0;        ///< index in Case::points
    sanitize::Machine machine = sanitize::Machine::ieee;
    std::string text;
};
void PrintTo(const CaseFault& fault, std::ostream* out);

/// What is wrong with the permutations that the case concerns, at each of its points, on every
/// machine that GLSL allows; at most `most` faults. `overlay` replaces pieces by include path.
[[nodiscard]] std::vector<CaseFault> faults_of(const Case& tested, const Overlay& overlay = {},
                                               std::size_t most = 8);

}  // namespace gobo
