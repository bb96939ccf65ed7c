// A study as tables, out and in again: what the report shows and what budgets choose by.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "lab/study/study.hpp"

namespace gobo::study {

/// Errors that differ by less than so many times that of the most accurate key, which has nothing but
/// roundings, are alike: which of two such is the smaller is chance.
inline constexpr double kChance = 2;

/// What a row costs on a chip, by its compiler's estimate.
struct ChipRow {
    std::string gpu;               ///< "navi21"
    std::string driver;            ///< "RDNA2, radv Mesa 25.0.7"
    std::optional<double> cycles;  ///< of 64 fragments with their part of the vertices; nothing: unknown
    bool on_front = false;
    std::map<std::string, double> instructions;  ///< of the fragment stage by kind
};

/// One row of study.csv: a key on a scene, or over all of them.
struct StudyRow : Measurement {
    std::string effects;  ///< key text
    std::string key;      ///< key text
    std::string quality;  ///< what differs from the most accurate key: "shading=vertex"
    std::string scene;
    Costs costs;
    bool on_front = false;
    std::string dominated_by;  ///< the quality of a key that is neither dearer nor less accurate
    std::optional<Timing> timing;
    std::optional<double> instructions;
    /// Whether no key that is as accurate is measurably faster. Nothing where the row was not timed, or the
    /// control of its combination of effects does not hold.
    std::optional<bool> on_time_front;
    /// Over the domain, as StudiedKey::worst has it; only in a study that `--worst` searched.
    std::optional<double> worst;
    std::vector<ChipRow> chips;  ///< read from a study that has them; in the order of its columns

    /// Nanoseconds of a fragment with its part of the vertices, as Costs::total; of a row that was timed.
    [[nodiscard]] Spread time() const;
};

/// Sorted as the study is: by effects, key, scene, the row of all scenes first.
[[nodiscard]] std::vector<StudyRow> rows_of(const Family& family, const Study& study, const Weights& weights);

[[nodiscard]] std::string study_csv(const std::vector<StudyRow>& rows);

/// All rows of a study.csv or summary.csv, but for the operations by kind. Errors, at `path` and the line: a
/// missing column, a key that the family does not have.
[[nodiscard]] Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path,
                                                      const Family& family);
/// Those of one combination of effects over all scenes; that the study does not hold it is an error too.
[[nodiscard]] Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path,
                                                      const Family& family, const Key& effects);

/// The rows of all scenes that are on their front or differ from the most accurate key in one feature: what
/// budgets need and readers compare.
[[nodiscard]] std::vector<StudyRow> summary_of(const Family& family, const std::vector<StudyRow>& rows);

/// The curves: feature, value, over, number, effects and the errors.
[[nodiscard]] std::string curves_csv(const std::vector<CurvePoint>& curves);

struct ChoiceSummary {
    std::string feature;
    std::string value;
    bool is_most_accurate = false;
    bool is_excluded = false;      ///< by the family
    std::size_t combinations = 0;  ///< of effects that it matters to
    double error_max = 0;          ///< alone, the worst over scenes and effects
    double error_rms = 0;
    double least_cost = 0;  ///< alone, relative to the most accurate key
    double most_cost = 0;
    /// The value that is neither dearer nor less accurate than this one in every pair of keys that differ in
    /// this feature alone, on every scene, and better in some. Empty: there is none.
    std::string dominated_by;
    std::size_t pairs = 0;  ///< of keys that say so
};

[[nodiscard]] std::vector<ChoiceSummary> summarise_choices(const Family& family, const Study& study,
                                                           const Weights& weights);

}  // namespace gobo::study
