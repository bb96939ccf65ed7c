#include "lab/study/measurement_json.hpp"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace gobo::study {
namespace {

/// JSON knows no infinity: null stands for it.
nlohmann::json number_json(double number) {
    return std::isfinite(number) ? nlohmann::json(number) : nlohmann::json(nullptr);
}

double number_of(const nlohmann::json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

evaluate::Counts counts_of(const nlohmann::json& json) {
    return json.get<evaluate::Counts>();
}

nlohmann::json spread_json(const Spread& spread) {
    return {spread.median, spread.low, spread.high};
}

Spread spread_from(const nlohmann::json& json) {
    return {json.at(0), json.at(1), json.at(2)};
}

}  // namespace

nlohmann::json to_json(const ErrorFigures& figures) {
    return {number_json(figures.max), number_json(figures.p999), number_json(figures.rms)};
}

nlohmann::json to_json(const Measurement& measurement) {
    return {{"total", to_json(measurement.total)},
            {"rounding", to_json(measurement.rounding)},
            {"approximation", to_json(measurement.approximation)},
            {"rate", to_json(measurement.rate)},
            {"relative", number_json(measurement.relative)},
            {"vertex_work", measurement.work.vertices},
            {"fragment_work", measurement.work.fragments},
            {"pixels", measurement.pixels},
            {"edges", measurement.edges},
            {"shown_vertices", measurement.shown_vertices},
            {"mesh_vertices", measurement.mesh_vertices},
            {"from_oracle", measurement.from_oracle}};
}

std::optional<ErrorFigures> error_figures_of(const nlohmann::json& json) {
    if (!json.is_array() || json.size() != 3) return std::nullopt;
    return ErrorFigures{number_of(json[0]), number_of(json[1]), number_of(json[2])};
}

std::optional<Measurement> measurement_of(const nlohmann::json& json) try {
    Measurement measurement;
    measurement.total = error_figures_of(json.at("total")).value();
    measurement.rounding = error_figures_of(json.at("rounding")).value();
    measurement.approximation = error_figures_of(json.at("approximation")).value();
    measurement.rate = error_figures_of(json.at("rate")).value();
    measurement.relative = number_of(json.at("relative"));
    measurement.work = {counts_of(json.at("vertex_work")), counts_of(json.at("fragment_work"))};
    measurement.pixels = json.at("pixels");
    measurement.edges = json.at("edges");
    measurement.shown_vertices = json.at("shown_vertices");
    measurement.mesh_vertices = json.at("mesh_vertices");
    measurement.from_oracle = json.at("from_oracle");
    return measurement;
} catch (const std::exception&) {
    return std::nullopt;  // written by another gobo: it is measured again
}

nlohmann::json to_json(const TimedGroup& group) {
    nlohmann::json timings = nlohmann::json::array();
    for (const Timing& timing : group.timings)
        timings.push_back({spread_json(timing.elapsed.fragment), spread_json(timing.elapsed.vertex),
                           spread_json(timing.processor.fragment), spread_json(timing.processor.vertex),
                           timing.rounds, timing.renderer});
    return {{"timings", timings}, {"control", {group.control.elapsed, group.control.processor}}};
}

std::optional<TimedGroup> timed_group_of(const nlohmann::json& json) try {
    TimedGroup group;
    for (const nlohmann::json& row : json.at("timings"))
        group.timings.push_back({{spread_from(row.at(0)), spread_from(row.at(1))},
                                 {spread_from(row.at(2)), spread_from(row.at(3))},
                                 row.at(4),
                                 row.at(5)});
    group.control = {json.at("control").at(0), json.at("control").at(1)};
    return group;
} catch (const std::exception&) {
    return std::nullopt;  // written by another gobo: it is timed again
}

}  // namespace gobo::study
