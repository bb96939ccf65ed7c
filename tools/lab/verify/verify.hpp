// Every permutation of a composition shown right: against the oracle where it has one, else fp32 against
// fp64.
#pragma once

#include <functional>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/oracle/model.hpp"
#include "lab/render/mesh.hpp"
#include "validate/validate.hpp"
#include "lab/verify/relations.hpp"
#include "lab/verify/report.hpp"

namespace gobo::verify {

struct VerifyOptions {
    int jobs = 1;         ///< threads
    int vertices = 128;   ///< samples of each vertex stage
    int fragments = 384;  ///< samples of each fragment stage
    /// So many of the last permutations are not verified: relations compare others with them.
    std::size_t partners = 0;
    /// The models that a key stands for; where it is not set, the one that the oracle knows it by.
    std::function<std::vector<oracle::Model>(const Key&)> models;
    std::vector<Mesh> meshes;  ///< on which the stages together are tried where there is an oracle
};

/// The stages of one permutation together.
struct PermutationReport {
    Key key;
    bool has_oracle = false;
    Figures figures;
    std::size_t points_on_meshes = 0;  ///< of figures.points
    std::size_t failed_points = 0;
    std::vector<Failure> worst;
    std::vector<RelationReport> relations;  ///< those that were tried
    Diagnostics diagnostics;                ///< why a stage could not be evaluated
};

/// At most this share of all points may lie at an edge.
inline constexpr double kLargestEdgeShare = 0.01;

struct VerifyReport {
    std::vector<PermutationReport> permutations;  ///< in the composition's order
    Figures figures;
    std::size_t points_on_meshes = 0;
    std::size_t without_oracle = 0;
};

/// `validated` must hold the SPIR-V of every stage. The samples depend on each key's text alone, so that a
/// key gives the same figures in any selection and with any number of jobs.
[[nodiscard]] VerifyReport verify(const Family& family, const Composition& composition,
                                  const Validated& validated, const VerifyOptions& options);

}  // namespace gobo::verify
