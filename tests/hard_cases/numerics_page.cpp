#include "numerics_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/file_system.hpp"
#include "common/text.hpp"
#include "common/text_template.hpp"
#include "plain_shaders.hpp"

namespace gobo {
namespace {

/// "H-N1" of "H_N1_zero_normal", and "zero normal".
struct CaseName {
    std::string id;
    std::string what;
};

CaseName split(const std::string& name) {
    std::string text = name;
    for (char& character : text)
        if (character == '_') character = ' ';
    if (name.starts_with("H_D1_H_D2_")) return {"H-D1, H-D2", text.substr(10)};
    if (name.starts_with("H_")) return {fmt::format("H-{}", text.substr(2, 2)), text.substr(5)};
    const auto space = text.find(' ');  // a model's case: "S15_in_the_shadow"
    return {text.substr(0, space), text.substr(space + 1)};
}

std::string number_text(double number) {
    if (std::isnan(number)) return "NaN";
    if (std::isinf(number)) return number > 0 ? "infinity" : "-infinity";
    return fmt::format("{:.6g}", number);
}

/// What a reader sees of a shaded point: the depth where the case is about it, otherwise the red channel.
std::string outcome(const Shaded& shaded, bool is_of_depth) {
    return number_text(is_of_depth && shaded.depth ? *shaded.depth : shaded.color[0]);
}

/// The part of a trap behind its place: "division by zero" of "shader_lib/a.glsl:3: division by zero: FDiv
/// ...".
std::string trap_text(const std::string& trap) {
    const auto begin = trap.find(": ");
    if (begin == std::string::npos) return trap;
    return trap.substr(begin + 2, trap.find(": ", begin + 2) - begin - 2);
}

std::string time_text(const GuardTimes& times, const std::string& name) {
    const auto found = times.find(name);
    if (found == times.end()) return "not measured";
    const GuardTime& time = found->second;
    if (time.guarded.median == 0) return "not timed: vertex stage";
    if (!time.is_measurable()) return "no measurable difference";
    return fmt::format("{:+.0f} %", 100 * (time.guarded.median / time.plain.median - 1));
}

std::string guard_row(const Guard& guard, const GuardTimes& times) {
    const Case* tested = case_named(guard.needed_by);
    EXPECT_NE(tested, nullptr) << guard.needed_by;
    if (tested == nullptr) return {};
    const Overlay overlay = {{guard.piece, without_guard(guard)}};
    const std::vector<CaseFault> faults = faults_of(*tested, overlay, 1);
    EXPECT_FALSE(faults.empty()) << guard.name;
    if (faults.empty()) return {};
    const CaseFault& fault = faults.front();
    const Inputs& point = tested->points[fault.point];
    const LitUnderTest plain(tested->where, tested->features, overlay);
    const LitUnderTest guarded(tested->where, tested->features, {});
    const Shaded without = plain.shade(fault.permutation, point, fault.machine);
    const Shaded with = guarded.shade(fault.permutation, point, fault.machine);
    const bool is_of_depth = tested->name.starts_with("H_D");
    const std::string trap = without.traps.empty() ? "" : ": " + trap_text(without.traps.front());
    const CaseName name = split(tested->name);
    return fmt::format("| {} | {} | `{}` | {}{} | {} | {} | {} | {} |\n", name.id, name.what, guard.guarded,
                       outcome(without, is_of_depth), trap, outcome(with, is_of_depth),
                       tested->check.tolerance, added_text(operations_of(guard)),
                       time_text(times, guard.name));
}

std::string guard_rows(const GuardTimes& times) {
    std::string rows;
    for (const Case& tested : lit_cases())
        for (const Guard& guard : lit_guards())
            if (guard.needed_by == tested.name) rows += guard_row(guard, times);
    return rows;
}

/// How far machines with the largest errors allowed are from double precision, relative where the colour is
/// above 1e-3; over all permutations and points of the case.
double largest_error(const Case& tested) {
    const LitUnderTest lit(tested.where, tested.features, {});
    double largest = 0;
    for (std::size_t permutation = 0; permutation < lit.size(); ++permutation)
        for (const Inputs& point : tested.points) {
            const Shaded exact = lit.shade_unwatched(permutation, point, kDouble);
            for (const auto machine : {sanitize::Machine::errors_up, sanitize::Machine::errors_down}) {
                const Shaded shaded = lit.shade_unwatched(permutation, point, machine);
                const double error =
                    std::abs(shaded.color[0] - exact.color[0]) / std::max(exact.color[0], 1e-3);
                if (std::isfinite(error)) largest = std::max(largest, error);
            }
        }
    return largest;
}

std::string case_rows() {
    std::string rows;
    for (const Case& tested : lit_cases()) {
        const CaseName name = split(tested.name);
        rows += fmt::format("| {} | {} | {} | {} | {:.0e} |\n", name.id, name.what, tested.points.size(),
                            tested.check.tolerance, largest_error(tested));
    }
    return rows;
}

/// The comment on a plain shader's second line: "H-L1: a light at the surface point."
std::string subject_of(const std::string& source) {
    const std::string_view line = line_of(source, 2);
    return std::string(line.substr(line.find("// ") + 3));
}

std::string plain_rows() {
    std::string rows;
    for (const std::string& path : shaders_in("plain")) {
        const std::string source = *DiskFileSystem().read(path);
        for (const sanitize::SharedFinding& shared : report_of(path).findings) {
            const sanitize::Finding& finding = shared.finding;
            rows += fmt::format("| {} | `{}:{}` | {} | `{}` |\n", subject_of(source),
                                path.substr(path.rfind('/') + 1), finding.place.line, finding.message,
                                finding.operation);
        }
    }
    return rows;
}

std::string renderer_of(const GuardTimes& times) {
    return times.empty() ? "no renderer" : times.begin()->second.renderer;
}

}  // namespace

std::string numerics_page(const GuardTimes& times) {
    const std::string path = GOBO_SOURCE_DIR "/tests/hard_cases/numerics.md.in";
    const Result<std::string> page = DiskFileSystem().read(path);
    EXPECT_TRUE(page);
    if (!page) return {};
    const Result<std::string> text = fill({"numerics.md.in", *page}, {{"guards", guard_rows(times)},
                                                                      {"cases", case_rows()},
                                                                      {"plain", plain_rows()},
                                                                      {"renderer", renderer_of(times)}});
    EXPECT_TRUE(text);
    return text ? *text : std::string();
}

}  // namespace gobo
