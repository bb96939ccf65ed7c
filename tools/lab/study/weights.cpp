#include "lab/study/weights.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/csv.hpp"

namespace gobo::study {
namespace {

Weights& of_renderer(std::vector<Weights>& all, const std::string& renderer) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Weights& one) { return one.renderer == renderer; });
    if (found != all.end()) return *found;
    all.push_back({renderer, 0, {}});
    return all.back();
}

}  // namespace

Result<std::vector<Weights>> read_weights(std::string_view csv, const std::string& path) {
    const auto problem = [&](std::size_t row, std::string message) {
        return fail_at_row(path, row, std::move(message),
                           "remake the weights: gobo study lit --weights -o FOLDER");
    };
    const CsvTable table = read_csv(csv);
    const auto renderer = table.column("renderer");
    const auto kind = table.column("kind");
    const auto weight = table.column("weight");
    const auto nanoseconds = table.column("nanoseconds");
    if (!renderer || !kind || !weight || !nanoseconds || table.rows.empty())
        return problem(0, "not a table of weights: renderer, kind, weight, nanoseconds");
    std::vector<Weights> all;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const std::vector<std::string>& row = table.rows[i];
        const auto at = std::find(evaluate::kKindNames.begin(), evaluate::kKindNames.end(), row[*kind]);
        const std::optional<double> number = number_in_cell(row[*weight]);
        const std::optional<double> time = number_in_cell(row[*nanoseconds]);
        if (at == evaluate::kKindNames.end())
            return problem(i, fmt::format("there is no kind of operation '{}'", row[*kind]));
        if (!number || *number < 0 || !time)
            return problem(i, fmt::format("'{}' is not a weight", row[*weight]));
        Weights& weights = of_renderer(all, row[*renderer]);
        weights.by_kind[static_cast<std::size_t>(at - evaluate::kKindNames.begin())] = *number;
        if (*number > 0) weights.nanoseconds = *time / *number;
    }
    return all;
}

std::string weights_csv(const std::vector<Weights>& weights) {
    CsvTable table{{"renderer", "kind", "weight", "nanoseconds"}, {}};
    for (const Weights& one : weights)
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            table.rows.push_back({one.renderer, std::string(evaluate::kKindNames[kind]),
                                  fmt::format("{:.3g}", one.by_kind[kind]),
                                  fmt::format("{:.3g}", one.by_kind[kind] * one.nanoseconds)});
    return csv_text(table);
}

double weighted(const evaluate::Counts& counts, const Weights& weights) {
    double sum = 0;
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        sum += weights.by_kind[kind] * static_cast<double>(counts[kind]);
    return sum;
}

Costs costs_of(const Measurement& measurement, const Weights& weights) {
    constexpr double kEnlargement =
        static_cast<double>(kFullWidth) * kFullHeight / (static_cast<double>(kSampleWidth) * kSampleHeight);
    const auto pixels = static_cast<double>(measurement.pixels);
    const auto vertices = static_cast<double>(std::max<std::size_t>(measurement.shown_vertices, 1));
    Costs costs;
    costs.fragment = weighted(measurement.work.fragments, weights) / pixels;
    costs.vertex = weighted(measurement.work.vertices, weights) / vertices;
    costs.vertices_per_fragment = static_cast<double>(measurement.mesh_vertices) / (pixels * kEnlargement);
    costs.total = costs.fragment + costs.vertex * costs.vertices_per_fragment;
    return costs;
}

}  // namespace gobo::study
