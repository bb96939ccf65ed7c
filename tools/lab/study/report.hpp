// The report of a study: one page that stands alone, and its main charts as files.
#pragma once

#include <map>
#include <string>

#include "lab/render/image.hpp"
#include "lab/study/rows.hpp"

namespace gobo::study {

/// A picture of where the error of a choice sits.
struct HeatMap {
    std::string quality;  ///< what differs from the most accurate key
    double largest = 0;   ///< error in the picture
    Image image;          ///< four channels, linear, for the eye
};

/// Each single choice of the plan's last quick effects on its first scene, 192 x 144, after a picture of the
/// scene itself (its quality is empty).
[[nodiscard]] Result<std::vector<HeatMap>> draw_heat_maps(const Subject& subject, const StudyPlan& plan);

/// All that the report shows.
struct ReportInput {
    const Family& family;
    const Study& study;
    const std::vector<StudyRow>& rows;
    const Weights& weights;
    std::vector<HeatMap> maps;
    std::string command;       ///< that made it
    std::string computer;      ///< the processor's name, where it was timed
    std::string guard_prices;  ///< CSV; empty: there is none
};

/// Files by name: index.html, front.svg, curves.*.svg, time.svg. `shipped` holds templates/study.
[[nodiscard]] Result<std::map<std::string, std::string>> make_report(const FileSystem& shipped,
                                                                     const ReportInput& input);

}  // namespace gobo::study
