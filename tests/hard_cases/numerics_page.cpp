#include "numerics_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "core/text.hpp"
#include "core/text_template.hpp"
#include "hard_case_index.hpp"
#include "normal_errors.hpp"
#include "pbr_guards.hpp"
#include "plain_shaders.hpp"

namespace gobo {
namespace {

/// A table's cell: bars would end it.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char character : text) escaped += character == '|' ? "\\|" : std::string(1, character);
    return escaped;
}

/// The same within backticks; nothing where there is no text.
std::string code(const std::string& text) {
    return text.empty() ? "" : fmt::format("`{}`", cell(text));
}

/// What a reader sees of a point, shaded without a guard and with it.
struct Outcomes {
    std::string plain;
    std::string ours;
};

/// In as many digits as tell the two apart.
Outcomes texts_of(double plain, double ours) {
    if (number_text(plain) != number_text(ours) || plain == ours || std::isnan(plain))
        return {number_text(plain), number_text(ours)};
    return {fmt::format("{:.9g}", plain), fmt::format("{:.9g}", ours)};
}

/// The depth where the case is about it, otherwise the colour's channel that differs most.
Outcomes outcomes(const Shaded& plain, const Shaded& ours, bool is_of_depth) {
    if (is_of_depth && plain.depth && ours.depth) return texts_of(*plain.depth, *ours.depth);
    std::size_t channel = 0;
    for (std::size_t i = 1; i < plain.color.size(); ++i)
        if (std::abs(plain.color[i] - ours.color[i]) > std::abs(plain.color[channel] - ours.color[channel]))
            channel = i;
    return texts_of(plain.color[channel], ours.color[channel]);
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
    return fmt::format("{:+.0f} % ({:.0f} to {:.0f}, {:.0f} to {:.0f})",
                       100 * (time.guarded.median / time.plain.median - 1), time.guarded.low,
                       time.guarded.high, time.plain.low, time.plain.high);
}

/// "navi21 +6 of 420, ampere 0 of 900": what the guard adds to the cycles of its stage without it.
std::string cycles_text(const GuardTimes& times, const std::string& name) {
    const auto found = times.find(name);
    if (found == times.end() || found->second.cycles.empty()) return "not costed";
    std::vector<std::string> parts;
    bool costs = false;
    for (const GuardCycles& cycles : found->second.cycles) {
        const auto added = static_cast<std::int64_t>(cycles.guarded - cycles.plain);
        costs = costs || added != 0;
        parts.push_back(fmt::format("{} {} of {}", cycles.gpu, added == 0 ? "0" : fmt::format("{:+}", added),
                                    cycles.plain));
    }
    return costs ? join(parts, ", ") : "none";
}

/// The versions of the drivers that cycles are from.
std::string drivers_of(const GuardTimes& times) {
    std::vector<std::string> drivers;
    for (const auto& [name, time] : times)
        for (const GuardCycles& cycles : time.cycles)
            if (std::find(drivers.begin(), drivers.end(), cycles.driver) == drivers.end())
                drivers.push_back(cycles.driver);
    return drivers.empty() ? "no driver" : join(drivers, " and ");
}

std::string name_in_words(const Case& tested) {
    return join(split(tested.name, '_'), " ");
}

/// "| tiny vector, huge vector | ordinary lengths".
std::string case_cells(const Case& tested) {
    return fmt::format("| {} | {}", fmt::join(tested.about, ", "), name_in_words(tested));
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
    const LitUnderTest plain(tested->where, tested->features, overlay, 0, tested->family);
    const LitUnderTest guarded(tested->where, tested->features, {}, 0, tested->family);
    const Shaded without = plain.shade(fault.permutation, point, fault.machine);
    const Shaded with = guarded.shade(fault.permutation, point, fault.machine);
    const bool is_physical = tested->about.empty();  // of pbr, whose cases have no catalogue
    const bool is_of_depth = !is_physical && tested->about.front().starts_with("depth");
    const std::string trap = without.traps.empty() ? "" : ": " + trap_text(without.traps.front());
    const Outcomes seen = outcomes(without, with, is_of_depth);
    const std::string common = fmt::format("{} | {}{} | {} | {} | {} | {} |", code(guard.guarded), seen.plain,
                                           trap, seen.ours, cell(tested->check.tolerance),
                                           added_text(operations_of(guard)), time_text(times, guard.name));
    if (is_physical) return fmt::format("| {} | {}\n", name_in_words(*tested), common);
    return fmt::format("{} | {} {} |\n", case_cells(*tested), common, cycles_text(times, guard.name));
}

std::string guard_rows(const std::vector<Case>& cases, const std::vector<Guard>& guards,
                       const GuardTimes& times) {
    std::string rows;
    for (const Case& tested : cases)
        for (const Guard& guard : guards)
            if (guard.needed_by == tested.name) rows += guard_row(guard, times);
    return rows;
}

/// How far machines with the largest errors allowed are from double precision, relative where the colour is
/// above 1e-3; over all points of the case and the permutations given.
double largest_error(const Case& tested, const LitUnderTest& lit) {
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

std::string case_row(const Case& tested) {
    const std::size_t permutations = LitUnderTest(tested.where, tested.features, {}).size();
    const LitUnderTest cover(tested.where, tested.features, {}, 2);
    return fmt::format("{} | {} | {} | {} | {:.0e} |\n", case_cells(tested), permutations,
                       tested.points.size(), cell(tested.check.tolerance), largest_error(tested, cover));
}

std::string case_rows() {
    std::string rows;
    for (const Case& tested : lit_cases()) rows += case_row(tested);
    return rows;
}

std::string file_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

std::string source_text(const std::string& path) {
    return *DiskFileSystem().read(path);
}

std::string trap_rows() {
    std::string rows;
    for (const std::string& path : shader_files("hard_cases/plain")) {
        const std::string subject = subject_of(source_text(path));
        for (const sanitize::SharedFinding& shared : sanitized_file(path, {}).findings) {
            const sanitize::Finding& finding = shared.finding;
            rows += fmt::format("| {} | `{}:{}` | {} | {} |\n", cell(subject), file_name(path),
                                finding.place.line, cell(finding.message), code(finding.operation));
            for (const sanitize::Consequence& one : finding.consequences)
                rows += fmt::format("| {} | `{}:{}` | and so {} | {} |\n", cell(subject), file_name(path),
                                    one.place.line, cell(one.message), code(one.operation));
        }
    }
    return rows;
}

/// Errors are those of single precision; formulas that are wrong are wrong in any.
std::string wrong_rows() {
    std::string rows;
    for (const std::string& path : shader_files("hard_cases/plain")) {
        const std::string source = source_text(path);
        for (const WrongMark& mark : wrong_marks(source))
            rows += fmt::format("| {} | `{}:{}` | `{}` | {} | {} | {} |\n", cell(subject_of(source)),
                                file_name(path), mark.line, mark.at,
                                number_text(result_of(path, mark.inputs, false)), mark.right,
                                mark.is_inexact ? "rounding" : "formula");
    }
    return rows;
}

/// "normalize_zero.frag, ..." of the plain shaders that name the case.
std::string plain_files_of(const HardCase& hard) {
    std::vector<std::string> names;
    for (const std::string& path : shader_files("hard_cases/plain")) {
        if (shows(source_text(path), hard)) names.push_back(fmt::format("`{}`", file_name(path)));
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string tests_of(const HardCase& hard) {
    std::vector<std::string> tests;
    const auto rows = std::count_if(lit_cases().begin(), lit_cases().end(),
                                    [&](const Case& tested) { return is_about(tested, hard); });
    if (rows > 0) tests.push_back(fmt::format("{} below", rows));
    for (const std::string& path : hard.elsewhere) tests.push_back(fmt::format("`{}`", path));
    return fmt::format("{}", fmt::join(tests, ", "));
}

std::string index_rows() {
    std::string rows;
    for (const HardCase& hard : hard_cases())
        rows += fmt::format("| {} | {} | {} | {} | {} | {} |\n", hard.name, hard.code, hard.input, hard.plain,
                            plain_files_of(hard), tests_of(hard));
    return rows;
}

std::string normal_rows() {
    std::string rows;
    for (const NormalErrors& errors : normal_errors())
        rows += fmt::format("| {} | {:.1e} | {:.1e} |\n", errors.away, errors.plain, errors.ours);
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
    const Result<std::string> text =
        fill({"numerics.md.in", *page}, {{"index", index_rows()},
                                         {"guards", guard_rows(lit_cases(), lit_guards(), times)},
                                         {"pbr_guards", guard_rows(pbr_cases(), pbr_guards(), times)},
                                         {"pbr_guard_count", std::to_string(pbr_guards().size())},
                                         {"guard_count", std::to_string(lit_guards().size())},
                                         {"cases", case_rows()},
                                         {"traps", trap_rows()},
                                         {"wrong", wrong_rows()},
                                         {"normals", normal_rows()},
                                         {"renderer", renderer_of(times)},
                                         {"drivers", drivers_of(times)}});
    EXPECT_TRUE(text);
    return text ? *text : std::string();
}

}  // namespace gobo
