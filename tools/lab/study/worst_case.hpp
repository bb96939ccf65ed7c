// The largest error of each quality over the whole domain of its inputs, which no scene need show: a search.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/study/points.hpp"

namespace gobo::study {

/// A key at the worst input found.
struct WorstCase {
    Key effects;
    Key key;
    /// How much further from the exact answer a channel of the fragment's colour is in fp32 than the
    /// roundings of floats explain at that input, as a part of the light that reaches the point (each
    /// light's, taken before its cosine weakens it; of `pbr` oracle::PhysicalRadiance::of_white), or of 1
    /// where less does. Infinite where it is no number.
    double error = 0;
    double rounding =
        0;  ///< what they explain there: the bound that verify::expect() derives, in the same unit
    std::uint64_t points = 0;
    evaluate::EvalPoint input;  ///< of the fragment stage
};

struct WorstCaseOptions {
    std::size_t points = 20000;  ///< of each key; half are drawn, half vary the worst so far
    std::uint64_t seed = 1;
    double enough =
        std::numeric_limits<double>::infinity();  ///< a key that errs by more is searched no further
    /// The varying, or variable of the pieces, that alone is declared mediump, in GLSL ES 3.00 evaluated with
    /// 16-bit floats; empty: none is. Fault::usage where no key's fragment stage has such a float.
    std::string mediump = {};
};

/// For each key, searched where its fragment stage may err most within the family's domains: inputs are those
/// of verify::make_samples(), with shininess from 1e-3 to 1e6 and cones from 1e-3 radians on, points beside
/// the cones' edges and anywhere in the view, and numbers at the ends of their domains; half of them have one
/// light alone, however many the key has. Points at a discontinuity are left out. Keys that the studied
/// dialect refuses are searched in GLSL ES 3.00 with 16-bit floats. No case for keys whose vertices hand over
/// what the most accurate key computes for each fragment (their errors hang on the mesh), nor for those whose
/// model the oracle does not know.
[[nodiscard]] Result<std::vector<WorstCase>> find_worst_cases(const Subject& subject,
                                                              const std::vector<Key>& keys,
                                                              const WorstCaseOptions& options);

/// A promise about a key, or about a quality with any effects: that it errs by no more.
struct Promise {
    std::string quality;  ///< "power=squaring", as quality_text() has it, or the text of a key
    double error = 0;
};

struct BrokenPromise {
    Promise promise;
    double error = 0;  ///< the worst that was found
};
/// The promises that some case breaks, in order.
[[nodiscard]] std::vector<BrokenPromise> broken_promises(const Family& family,
                                                         const std::vector<Promise>& promises,
                                                         const std::vector<WorstCase>& cases);

/// The study.csv with what the cases found in the column error_worst of the rows of all scenes; "none" for
/// keys that they leave out.
[[nodiscard]] CsvTable with_worst(CsvTable study, const Family& family, const std::vector<WorstCase>& cases);

/// A table: effects, quality, its worst error, what roundings explain there besides, and points tried.
[[nodiscard]] std::string worst_case_csv(const Family& family, const std::vector<WorstCase>& cases);

}  // namespace gobo::study
