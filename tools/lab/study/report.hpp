// The report of a study: one page that stands alone, and its main charts as files.
#pragma once

#include <map>
#include <string>

#include "core/file_system.hpp"
#include "lab/study/choices.hpp"
#include "lab/study/heat_maps.hpp"
#include "lab/study/time_study.hpp"

namespace gobo::study {

/// All that the report shows.
struct ReportInput {
    const Family& family;
    const Study& study;
    const std::vector<StudyRow>& rows;
    const Weights& weights;
    std::vector<HeatMap> maps;
    std::string command;       ///< that made it
    std::string machine;       ///< the processor's name, where it was timed
    std::string guard_prices;  ///< CSV; empty: there is none
};

/// Files by name: index.html, front.svg, curves.*.svg, time.svg. `shipped` holds templates/study.
[[nodiscard]] Result<std::map<std::string, std::string>> make_report(const FileSystem& shipped,
                                                                     const ReportInput& input);

}  // namespace gobo::study
