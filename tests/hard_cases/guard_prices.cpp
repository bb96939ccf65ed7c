#include "guard_prices.hpp"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "core/csv.hpp"
#include "core/file_system.hpp"
#include "core/text.hpp"
#include "lab/cost/compile_on_chips.hpp"
#include "lab/cost/stage_cost.hpp"
#include "lit_drawing.hpp"
#include "pbr_guards.hpp"

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
    const auto with = [&](const Overlay& overlay) {
        return LitUnderTest(concerned.where, concerned.features, overlay, 0, concerned.family);
    };
    Pair pair{with({}), with({{guard.piece, without_guard(guard)}})};
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
    if (!pair.is_in_fragment) return {{}, {}, context.renderer(), {}};
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

Result<std::map<std::string, std::vector<GuardCycles>>> measure_cycles(const std::string& folder,
                                                                       const std::string& lab) {
    std::vector<cost::Pipeline> pipelines;
    std::vector<std::string> stages;
    const std::vector<Guard> guards = all_guards();
    for (const Guard& guard : guards) {
        const Pair pair = pair_of(guard);
        stages.emplace_back(pair.is_in_fragment ? "fragment" : "vertex");
        for (const LitUnderTest* lit : {&pair.guarded, &pair.plain}) {
            std::vector<cost::PipelineStage> both;
            for (const StageKind kind : {StageKind::vertex, StageKind::fragment})
                both.push_back({kind, lit->spirv(pair.permutation, kind)});
            GOBO_TRY(auto pipeline, cost::pipeline_of(std::move(both)));
            pipelines.push_back(std::move(pipeline));
        }
    }
    GOBO_TRY(const auto chips, cost::chips_named({kGuardChips.begin(), kGuardChips.end()}));
    const auto answers = cost::compile_on_chips(DiskFileSystem(), chips, pipelines,
                                                {.driver = folder, .program = lab, .jobs = 2});
    std::map<std::string, std::vector<GuardCycles>> all;
    for (std::size_t chip = 0; chip < chips.size(); ++chip) {
        GOBO_TRY(const auto answer, answers[chip]);
        for (std::size_t i = 0; i < stages.size(); ++i) {
            GuardCycles& cycles = all[guards[i].name].emplace_back();
            cycles.gpu = chips[chip].name;
            cycles.driver = answer.driver;
            for (const bool guarded : {true, false}) {
                const auto& compiled = answer.pipelines[2 * i + (guarded ? 0 : 1)];
                if (!compiled) return fail(Fault::input, compiled.error());
                for (const cost::CompiledStage& stage : *compiled)
                    if (stage.stage == stages[i])
                        (guarded ? cycles.guarded : cycles.plain) =
                            cost::cost_of(stage, chips[chip], false).cycles;
            }
        }
    }
    return all;
}

std::string to_csv(const GuardTimes& times) {
    CsvTable table;
    table.columns = {"guard",
                     "case",
                     "piece",
                     "key",
                     "operations_guarded",
                     "operations_plain",
                     "guarded_us_low",
                     "guarded_us",
                     "guarded_us_high",
                     "plain_us_low",
                     "plain_us",
                     "plain_us_high",
                     "renderer"};
    for (const char* gpu : kGuardChips)
        for (const char* column : {"cycles_{}_guarded", "cycles_{}_plain", "driver_{}"})
            table.columns.push_back(fmt::format(fmt::runtime(column), gpu));
    for (const Guard& guard : all_guards()) {
        const auto found = times.find(guard.name);
        if (found == times.end()) continue;
        const GuardTime& time = found->second;
        const GuardOperations operations = operations_of(guard);
        std::vector<std::string>& row = table.rows.emplace_back();
        row = {guard.name,
               guard.needed_by,
               guard.piece,
               operations.key,
               std::to_string(computing(operations.guarded)),
               std::to_string(computing(operations.plain))};
        for (const GuardTime::Quartiles& quartiles : {time.guarded, time.plain})
            for (const double end : {quartiles.low, quartiles.median, quartiles.high})
                row.push_back(fmt::format("{:.0f}", end));
        row.push_back(time.renderer);
        for (const GuardCycles& cycles : time.cycles)
            row.insert(row.end(),
                       {std::to_string(cycles.guarded), std::to_string(cycles.plain), cycles.driver});
        row.resize(table.columns.size());
    }
    return csv_text(table);
}

GuardTimes times_of_csv(const std::string& csv) {
    const CsvTable table = read_csv(csv);
    GuardTimes times;
    for (const std::vector<std::string>& row : table.rows) {
        const auto cell = [&](const std::string& name) {
            const auto column = table.column(name);
            return column ? row[*column] : "";
        };
        const auto number = [&](const std::string& name) {
            return number_from<double>(cell(name)).value_or(0);
        };
        GuardTime& time = times[cell("guard")];
        time.guarded = {number("guarded_us_low"), number("guarded_us"), number("guarded_us_high")};
        time.plain = {number("plain_us_low"), number("plain_us"), number("plain_us_high")};
        time.renderer = cell("renderer");
        for (const char* gpu : kGuardChips) {
            const std::string prefix = fmt::format("cycles_{}", gpu);
            if (cell(prefix + "_guarded").empty()) continue;
            time.cycles.push_back({gpu, cell(fmt::format("driver_{}", gpu)),
                                   static_cast<std::uint64_t>(number(prefix + "_guarded")),
                                   static_cast<std::uint64_t>(number(prefix + "_plain"))});
        }
    }
    return times;
}

}  // namespace gobo
