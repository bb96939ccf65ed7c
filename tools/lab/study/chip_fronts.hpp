// Fronts by what the compilers of GPUs estimate, beside that by weighted operations: where they differ, and
// why. For readers.
#pragma once

#include "core/file_system.hpp"
#include "lab/study/front.hpp"

namespace gobo::study {

/// What a front's cost is.
struct Measure {
    std::string gpu = {};     ///< cycles of this chip; empty: weighted additions
    std::string driver = {};  ///< as the rows name it

    /// "navi21" or "llvmpipe", whose weights the additions have.
    [[nodiscard]] std::string name() const { return gpu.empty() ? "llvmpipe" : gpu; }
    [[nodiscard]] std::optional<double> cost(const StudyRow& row) const;
    [[nodiscard]] bool on_front(const StudyRow& row) const;
    /// The row's figures of the chip; nullptr where it has none.
    [[nodiscard]] const ChipRow* chip(const StudyRow& row) const;
};

/// Weighted additions, then cycles of the chips of those names; of all that the rows have, where none is
/// named. Fault::input for a chip that they do not have.
[[nodiscard]] Result<std::vector<Measure>> measures_of(const std::vector<StudyRow>& rows,
                                                       const std::vector<std::string>& gpus);

/// A table in Markdown of one combination of effects: of each measure's front the most accurate quality and
/// for each power of ten of the error the cheapest. Bold: on that front.
[[nodiscard]] std::string fronts_table(const std::vector<StudyRow>& rows,
                                       const std::vector<Measure>& measures);

/// Error against cost relative to the most accurate quality, a chart for each measure, one above another.
/// What is on any of the fronts has the same number in all of them.
[[nodiscard]] std::string fronts_svg(const Family& family, const std::vector<std::string>& rate,
                                     const std::vector<const StudyRow*>& rows, const std::string& title,
                                     const std::vector<Measure>& measures);

/// Two values of a quality feature that are dearer and cheaper in another order by some chip than by weighted
/// additions, in Markdown, with the instructions that make the difference.
[[nodiscard]] std::string changed_places_table(const Family& family, const std::vector<StudyRow>& rows,
                                               const std::vector<Measure>& measures);

/// Each value of the quality features, in Markdown: on how many fronts it is, of as many combinations of
/// effects and scenes as it matters to.
[[nodiscard]] std::string values_table(const Family& family, const std::vector<StudyRow>& rows,
                                       const std::vector<Measure>& measures);

/// All of it as a page.
[[nodiscard]] std::string fronts_page(const Family& family, const std::vector<std::string>& rate,
                                      const std::vector<StudyRow>& rows,
                                      const std::vector<Measure>& measures);

}  // namespace gobo::study
