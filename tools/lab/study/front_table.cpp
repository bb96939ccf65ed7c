#include "lab/study/front_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "lab/study/chart.hpp"
#include "lab/study/time_study.hpp"

namespace gobo::study {
namespace {

/// The order of the front: what is more accurate on it is dearer.
bool is_more_accurate(const StudyRow* a, const StudyRow* b) {
    return std::tuple(b->costs.total, a->key) < std::tuple(a->costs.total, b->key);
}

/// The most accurate row, then for each power of ten of the error the cheapest row within it.
std::vector<const StudyRow*> cheapest_by_decade(const std::vector<const StudyRow*>& front) {
    std::vector<const StudyRow*> chosen = {front.front()};
    for (const StudyRow* row : front) {
        if (row == front.front()) continue;
        const auto decade = [](const StudyRow& one) { return std::ceil(std::log10(one.error.max)); };
        if (chosen.size() > 1 && decade(*chosen.back()) == decade(*row))
            chosen.back() = row;  // less accurate on the front is cheaper
        else
            chosen.push_back(row);
    }
    return chosen;
}

/// How far the row's cost is from that of the nearest row chosen, as a ratio of 1 or more.
double distance(const StudyRow& row, const std::vector<const StudyRow*>& chosen) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const StudyRow* other : chosen)
        nearest = std::min(
            nearest, std::max(row.costs.total / other->costs.total, other->costs.total / row.costs.total));
    return nearest;
}

/// Up to kFrontLines lines, where the front has so many: whichever row's cost is furthest from those chosen.
void fill_up(const std::vector<const StudyRow*>& front, std::vector<const StudyRow*>& chosen) {
    while (chosen.size() < std::min(kFrontLines, front.size()))
        chosen.push_back(*std::max_element(front.begin(), front.end(), [&](const auto* a, const auto* b) {
            return distance(*a, chosen) < distance(*b, chosen);
        }));
    std::sort(chosen.begin(), chosen.end(), is_more_accurate);
}

}  // namespace

std::string spread_text(const Spread& spread) {
    return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.low),
                       short_number(spread.high));
}

std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows) {
    std::vector<const StudyRow*> front;
    for (const StudyRow* row : rows)
        if (row->on_front) front.push_back(row);
    std::sort(front.begin(), front.end(), is_more_accurate);
    return front;
}

std::string front_table(const std::vector<StudyRow>& rows) {
    std::vector<const StudyRow*> all;
    for (const StudyRow& row : rows) all.push_back(&row);
    const std::vector<const StudyRow*> front = front_of(all);
    std::vector<const StudyRow*> lines = front;
    if (!lines.empty()) lines = cheapest_by_decade(lines);
    if (lines.size() > kFrontLines) lines.erase(lines.begin() + 1, lines.end() - (kFrontLines - 1));
    fill_up(front, lines);
    std::string text =
        "| quality | largest error | RMS error | cost, additions | time, ns |\n|---|---|---|---|---|\n";
    for (const StudyRow* row : lines)
        text += fmt::format("| {} | {} | {} | {} | {} |\n",
                            row->quality.empty() ? "most accurate" : "`" + row->quality + "`",
                            short_number(row->error.max), short_number(row->error.rms),
                            short_number(row->costs.total), row->timing ? spread_text(time_of(*row)) : "");
    return text;
}

}  // namespace gobo::study
