// Parts of the report. Internal to it.
#pragma once

#include "lab/study/chart.hpp"
#include "lab/study/report.hpp"

namespace gobo::study {

/// An <option>.
[[nodiscard]] std::string option(const std::string& value, const std::string& label);

/// A table: the header's cells and the rows'; a cell that begins with a digit, a sign or a multiplication
/// sign is set as a number. `classes` are of the rows; empty: none.
[[nodiscard]] std::string html_table(const std::vector<std::string>& header,
                                     const std::vector<std::vector<std::string>>& rows,
                                     const std::vector<std::string>& classes = {});

/// The scatter of one combination of effects on one scene.
[[nodiscard]] Chart scatter_of(const ReportInput& input, const std::string& effects,
                               const std::string& scene);
/// All of them as figures, the first one shown, each with the table of its front.
[[nodiscard]] std::string scatter_figures(const ReportInput& input);

/// One chart for each feature and what it is measured along, by name: "curve.shading.svg".
[[nodiscard]] std::map<std::string, Chart> curve_charts(const ReportInput& input);

/// The cost of fragments, or of vertices, against their time.
[[nodiscard]] Chart time_chart(const CostAndTime& points, bool of_vertices, bool by_processor);

[[nodiscard]] std::string choices_table(const ReportInput& input);
[[nodiscard]] std::string time_section(const ReportInput& input);
[[nodiscard]] std::string changes_section(const ReportInput& input);
[[nodiscard]] std::string guards_section(const ReportInput& input);
[[nodiscard]] std::string method_section(const ReportInput& input);
[[nodiscard]] Result<std::string> map_figures(const ReportInput& input);
[[nodiscard]] std::string heat_scale();

}  // namespace gobo::study
