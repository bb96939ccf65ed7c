// Every permutation of a composition shown right: against the oracle where it has one, else fp32 against
// fp64.
#pragma once

#include <functional>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/oracle/model.hpp"
#include "lab/render/mesh.hpp"
#include "lab/verify/relations.hpp"
#include "lab/verify/report.hpp"
#include "validate/validate.hpp"

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

/// The stages of one permutation together; twice as many worst points are kept.
struct PermutationReport : StageReport {
    Key key;
    bool has_oracle = false;
    std::size_t points_on_meshes = 0;       ///< of figures.points
    std::size_t points_of_laws = 0;         ///< of figures.points
    std::vector<RelationReport> relations;  ///< those that were tried
    Diagnostics diagnostics;                ///< why a stage could not be evaluated
};

/// At most this share of all points may lie at an edge.
inline constexpr double kLargestEdgeShare = 0.01;

struct VerifyReport {
    std::vector<PermutationReport> permutations;  ///< in the composition's order
    Figures figures;
    std::size_t points_on_meshes = 0;
    std::size_t points_of_laws = 0;  ///< see check_laws()
    std::size_t without_oracle = 0;
};

/// `validated` must hold the SPIR-V of every stage. The samples depend on each key's text alone, so that a
/// key gives the same figures in any selection and with any number of jobs.
[[nodiscard]] VerifyReport verify(const Family& family, const Composition& composition,
                                  const Validated& validated, const VerifyOptions& options);

/// The family's name and `permutations`, in the report's order: for each its key's text, how many points it
/// was tried at, and its largest fp32 and fp64 errors, relative to the largest term of the light
/// (docs/formats.md). An error that is no finite number is null. A newline ends the text.
/// docs/models.md is made of them.
[[nodiscard]] std::string figures_json(const Family& family, const VerifyReport& report);

}  // namespace gobo::verify
