#include "lab/verify/report.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace gobo::verify {
std::string_view name_of(Precision precision) {
    return precision == Precision::fp32 ? "fp32" : "fp64";
}

double ratio_of(double error, double limit) {
    if (error == 0) return 0;
    return error <= std::numeric_limits<double>::max() && limit > 0 ? error / limit
                                                                    : std::numeric_limits<double>::infinity();
}

Figures& Figures::operator+=(const Figures& other) {
    points += other.points;
    edges += other.edges;
    largest_fp64_error = std::max(largest_fp64_error, other.largest_fp64_error);
    largest_fp32_error = std::max(largest_fp32_error, other.largest_fp32_error);
    largest_fp32_ratio = std::max(largest_fp32_ratio, other.largest_fp32_ratio);
    vacuous += other.vacuous;
    loose += other.loose;
    unexplained += other.unexplained;
    return *this;
}

void StageReport::add(Failure failure, std::size_t most) {
    const auto place = std::find_if(worst.begin(), worst.end(),
                                    [&](const Failure& other) { return other.ratio < failure.ratio; });
    worst.insert(place, std::move(failure));
    if (worst.size() > most) worst.pop_back();
}

void StageReport::add(StageReport other, std::size_t most) {
    figures += other.figures;
    failed_points += other.failed_points;
    for (Failure& failure : other.worst) add(std::move(failure), most);
    if (other.least_explained && (!least_explained || other.least_explained->ratio > least_explained->ratio))
        least_explained = std::move(other.least_explained);
}

std::string to_text(const Failure& failure) {
    return fmt::format("{} {}[{}] is {}, should be {} within {:.3g}", name_of(failure.precision),
                       failure.output, failure.component, failure.actual, failure.expected,
                       failure.tolerance);
}

std::string eval_input(const Failure& failure, const std::string& key) {
    return evaluate::eval_file(gobo::name_of(failure.stage), failure.point,
                               {fmt::format("{}: {}", key, to_text(failure))}, evaluate::Digits::all);
}

}  // namespace gobo::verify
