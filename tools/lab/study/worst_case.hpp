// The largest error of each quality over the whole domain of its inputs, which no scene need show: a search.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/evaluate/eval_file.hpp"
#include "lab/study/points.hpp"

namespace gobo::study {

/// One quality that differs from the most accurate one in a single value, at the worst input found.
struct WorstCase {
    Key effects;
    Key key;
    /// Of a channel of the fragment's colour in fp32, as a part of the light that reaches the point (each
    /// light's, taken before its cosine weakens it), or of 1 where less does.
    double error = 0;
    double accurate_error = 0;  ///< of the most accurate quality at the same input
    std::uint64_t points = 0;
    evaluate::EvalPoint input;  ///< of the fragment stage
};

struct WorstCaseOptions {
    std::size_t points = 20000;  ///< of each quality; half are drawn, half vary the worst so far
    std::uint64_t seed = 1;
    std::vector<Domain> domains;  ///< narrower ones, ahead of the family's
};

/// For each combination of effects and each single choice of a quality feature that is computed in the
/// fragment stage (`rate` names the features that say where light is computed, whose error hangs on the
/// mesh). Inputs are those of verify::make_samples(), with shininess from 0.1 to 1e6 and cones from 1e-3
/// radians on, points beside the cones' edges, within the domains; the search maximises by how much the
/// choice errs more than the most accurate quality, so that it finds what the choice costs and no
/// ill-conditioned inputs. Points at a discontinuity are left out. Choices whose model the oracle does not
/// know are left out too.
[[nodiscard]] Result<std::vector<WorstCase>> find_worst_cases(const Subject& subject,
                                                              const std::vector<Key>& effects,
                                                              const std::vector<int>& rate,
                                                              const WorstCaseOptions& options);

/// A promise about a quality: that it errs by no more.
struct Promise {
    std::string quality;  ///< "power=squaring"
    double error = 0;
};

/// The promises that some case breaks, in order.
[[nodiscard]] std::vector<Promise> broken_promises(const Family& family, const std::vector<Promise>& promises,
                                                   const std::vector<WorstCase>& cases);

/// A table: effects, quality, its worst error, the most accurate quality's there, and points tried.
[[nodiscard]] std::string worst_case_csv(const Family& family, const std::vector<WorstCase>& cases);

}  // namespace gobo::study
