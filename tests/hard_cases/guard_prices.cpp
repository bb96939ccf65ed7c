#include "guard_prices.hpp"

#include <algorithm>
#include <ctime>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "lit_drawing.hpp"

namespace gobo {
namespace {

using evaluate::Kind;

constexpr int kRounds = 21;
constexpr int kPixels = 256;

/// The permutations of a guard's case, with the guard and without it.
struct Pair {
    LitUnderTest guarded;
    LitUnderTest plain;
    std::size_t permutation = 0;
    bool is_in_fragment = true;
};

/// A piece's path as if each had a file of its own: "shader_lib/fog.glsl#linear" is
/// shader_lib/fog/linear.glsl.
std::string path_of(const Piece& piece) {
    const std::size_t mark = piece.name.find(".glsl#");
    if (mark == std::string::npos) return piece.name;
    return piece.name.substr(0, mark) + "/" + piece.name.substr(mark + 6) + ".glsl";
}

bool has_piece(const Composition& composition, int stage, const std::string& piece) {
    const std::vector<int>& pieces = composition.stages[static_cast<std::size_t>(stage)].pieces;
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](int at) { return path_of(composition.piece(at)).ends_with("/" + piece); });
}

/// Finds the first permutation whose fragment stage the guard is in, or else whose vertex stage.
void find_permutation(Pair& pair, const std::string& piece) {
    const Composition& composition = pair.guarded.composition();
    for (const bool is_in_fragment : {true, false})
        for (std::size_t i = 0; i < pair.guarded.size(); ++i) {
            const StageNumbers& stages = composition.permutations[i].stages;
            const StageKind kind = is_in_fragment ? StageKind::fragment : StageKind::vertex;
            if (!has_piece(composition, stages[kind], piece)) continue;
            pair.permutation = i;
            pair.is_in_fragment = is_in_fragment;
            return;
        }
    ADD_FAILURE() << "no permutation of the case has " << piece;
}

Pair pair_of(const Guard& guard) {
    const Case* tested = case_named(guard.needed_by);
    EXPECT_NE(tested, nullptr) << guard.needed_by;
    static const Case none{};
    const Case& concerned = tested == nullptr ? none : *tested;
    Pair pair{LitUnderTest(concerned.where, concerned.features, {}),
              LitUnderTest(concerned.where, concerned.features, {{guard.piece, without_guard(guard)}})};
    find_permutation(pair, guard.piece);
    return pair;
}

evaluate::Counts counts_of(const LitUnderTest& lit, std::size_t permutation, bool is_in_fragment) {
    evaluate::Options options;
    options.count = true;
    const StageInputs inputs = lit.inputs_of(permutation, {}, sanitize::Machine::ieee);
    const auto outputs = is_in_fragment
                             ? evaluate::run<float>(lit.fragment(permutation), inputs.fragment, options)
                             : evaluate::run<float>(lit.vertex(permutation), inputs.vertex, options);
    EXPECT_TRUE(outputs);
    return outputs ? outputs->counts.front() : evaluate::Counts{};
}

bool computes(Kind kind) {
    return kind != Kind::move && kind != Kind::load && kind != Kind::store && kind != Kind::call;
}

GuardTime::Quartiles quartiles_of(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return {times[times.size() / 4], times[times.size() / 2], times[times.size() * 3 / 4]};
}

/// Of the whole process, so that others on the machine do not count.
double processor_microseconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

/// Microseconds of one draw. A timer query would not do: llvmpipe's are worthless.
double time_of(LitDrawing& drawing, const Context& context) {
    context.gl().Finish();
    const double begin = processor_microseconds();
    drawing.cover({});
    context.gl().Finish();
    return processor_microseconds() - begin;
}

}  // namespace

GuardOperations operations_of(const Guard& guard) {
    const Pair pair = pair_of(guard);
    return {pair.guarded.key(pair.permutation),
            counts_of(pair.guarded, pair.permutation, pair.is_in_fragment),
            counts_of(pair.plain, pair.permutation, pair.is_in_fragment)};
}

std::uint64_t computing(const evaluate::Counts& counts) {
    std::uint64_t sum = 0;
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
        if (computes(static_cast<Kind>(kind))) sum += counts[kind];
    return sum;
}

std::string added_text(const GuardOperations& operations) {
    std::vector<std::string> parts;
    for (std::size_t kind = 0; kind < operations.guarded.size(); ++kind) {
        const auto added = static_cast<std::int64_t>(operations.guarded[kind] - operations.plain[kind]);
        if (added != 0 && computes(static_cast<Kind>(kind)))
            parts.push_back(fmt::format("{:+} {}", added, evaluate::kKindNames[kind]));
    }
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

bool GuardTime::is_measurable() const {
    return guarded.low > plain.high || plain.low > guarded.high;
}

GuardTime measure(const Guard& guard, const Context& context) {
    const Pair pair = pair_of(guard);
    if (!pair.is_in_fragment) return {{}, {}, context.renderer()};
    LitDrawing guarded(context, pair.guarded, pair.permutation);
    LitDrawing plain(context, pair.plain, pair.permutation);
    const Result<Framebuffer> target = make_framebuffer(context, kPixels, kPixels);
    EXPECT_TRUE(target);
    GuardTime time;
    time.renderer = context.renderer();
    if (!target) return time;
    target->bind();
    context.gl().Disable(GL_DEPTH_TEST);
    std::vector<double> guarded_times;
    std::vector<double> plain_times;
    for (int round = -2; round < kRounds; ++round) {  // the first draws compile
        const double with = time_of(guarded, context);
        const double without = time_of(plain, context);
        if (round < 0) continue;
        guarded_times.push_back(with);
        plain_times.push_back(without);
    }
    time.guarded = quartiles_of(guarded_times);
    time.plain = quartiles_of(plain_times);
    return time;
}

std::string to_csv(const GuardTimes& times) {
    std::string csv =
        "guard,case,piece,key,operations_guarded,operations_plain,guarded_us_low,guarded_us,guarded_us_high,"
        "plain_us_low,plain_us,plain_us_high,renderer\n";
    for (const Guard& guard : lit_guards()) {
        const auto found = times.find(guard.name);
        if (found == times.end()) continue;
        const GuardTime& time = found->second;
        const GuardOperations operations = operations_of(guard);
        csv +=
            fmt::format("{},{},{},{},{},{},{:.0f},{:.0f},{:.0f},{:.0f},{:.0f},{:.0f},\"{}\"\n", guard.name,
                        guard.needed_by, guard.piece, operations.key, computing(operations.guarded),
                        computing(operations.plain), time.guarded.low, time.guarded.median, time.guarded.high,
                        time.plain.low, time.plain.median, time.plain.high, time.renderer);
    }
    return csv;
}

GuardTimes times_of_csv(const std::string& csv) {
    GuardTimes times;
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);  // its heading
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; cells.size() < 12 && std::getline(row, cell, ',');) cells.push_back(cell);
        if (cells.size() < 12) continue;
        std::string renderer;
        std::getline(row, renderer);
        std::erase(renderer, '"');
        const auto number = [&](std::size_t at) { return std::stod(cells[at]); };
        times[cells[0]] = {{number(6), number(7), number(8)}, {number(9), number(10), number(11)}, renderer};
    }
    return times;
}

}  // namespace gobo
