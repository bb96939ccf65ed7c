#include "lab/study/timing.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/raster/random.hpp"
#include "lab/raster/raster_object.hpp"
#include "lab/study/draw_clock.hpp"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define GOBO_HAS_CALLGRIND 1
#else
#define GOBO_HAS_CALLGRIND 0
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#endif

namespace gobo::study {
namespace {

/// Nanoseconds.
using Instant = ByClock<double>;

Instant now() {
    timespec processor{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &processor);
    const auto elapsed = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double, std::nano>(elapsed).count(),
            static_cast<double>(processor.tv_sec) * 1e9 + static_cast<double>(processor.tv_nsec)};
}

Instant operator-(const Instant& a, const Instant& b) {
    return {a.elapsed - b.elapsed, a.processor - b.processor};
}

/// Nanoseconds for one fragment or vertex, one a round.
using Laps = ByClock<std::vector<double>>;

void add(const Instant& lap, double count, Laps& laps) {
    laps.elapsed.push_back(lap.elapsed / count);
    laps.processor.push_back(lap.processor / count);
}

/// A linked program with what it draws: the scene, and spheres of few and of many vertices.
struct Timed {
    DrawList scene;
    DrawList few;
    DrawList many;
    double fragments = 0;  ///< that the large target has more than the small one
    Laps fragment = {};
    Laps vertex = {};
};

double off(const Spread& first, const Spread& second) {
    return second.median > 0 ? std::abs(first.median / second.median - 1) : 1;
}

/// The last one timed is the second copy of the first.
TimedGroup group_of(const std::vector<Timed>& all, int rounds, const std::string& renderer) {
    TimedGroup group;
    for (const Timed& timed : all)
        group.timings.push_back({{{spread_of(timed.fragment.elapsed), spread_of(timed.vertex.elapsed)},
                                  {spread_of(timed.fragment.processor), spread_of(timed.vertex.processor)}},
                                 rounds,
                                 renderer});
    const Timing control = group.timings.back();
    group.timings.pop_back();
    const Timing& first = group.timings.front();
    group.control = {off(control.elapsed.fragment, first.elapsed.fragment),
                     off(control.processor.fragment, first.processor.fragment)};
    return group;
}

/// An order that is another one in every round, and the same in every run.
std::vector<std::size_t> order_of(std::size_t count, int round) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    Random random(static_cast<std::uint64_t>(round) + 1);
    for (std::size_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.whole(0, static_cast<int>(i) - 1))]);
    return order;
}

/// What a program prints, both streams; nothing where it cannot be run or fails.
std::optional<std::string> printed_by(std::vector<std::string> command) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return std::nullopt;
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    const ::pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        ::dup2(ends[1], STDERR_FILENO);
        ::close(ends[0]);
        ::close(ends[1]);
        ::execvp(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    std::string text;
    std::array<char, 4096> buffer{};
    FILE* printed = ::fdopen(ends[0], "r");
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), printed))
        text.append(buffer.data(), count);
    std::fclose(printed);
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child || status != 0) return std::nullopt;
    return text;
}

/// The number after a word.
std::optional<double> number_after(const std::string& text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string::npos) return std::nullopt;
    return std::strtod(text.c_str() + at + word.size(), nullptr);
}

Result<ByKind> counts_of(const ScenePoints& points, const Variant& variant) {
    raster::Work work;
    GOBO_TRY_DO(shade_points<float>(points, variant, &work));
    ByKind counts{};
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        counts[kind] = static_cast<double>(work.fragments[kind]) / static_cast<double>(points.pixels);
    return counts;
}

Weights weights_of(const ByKind& prices, const std::string& renderer) {
    Weights weights;
    weights.renderer = renderer;
    weights.nanoseconds = prices[static_cast<std::size_t>(evaluate::Kind::add)];
    for (std::size_t kind = 0; kind < evaluate::kKinds && weights.nanoseconds > 0; ++kind)
        weights.by_kind[kind] = prices[kind] / weights.nanoseconds;
    return weights;
}

}  // namespace

void make_timings_repeatable() {
    ::setenv("LP_NUM_THREADS", "0", 1);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

bool draws_in_calling_thread(const std::string& renderer) {
    return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

double count_fragments(const Context& context, const DrawList& list) {
    const GladGLContext& gl = context.gl();
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    GLuint query = 0;
    gl.GenQueries(1, &query);
    gl.BeginQuery(GL_SAMPLES_PASSED, query);
    list.draw();
    gl.EndQuery(GL_SAMPLES_PASSED);
    GLuint passed = 0;
    gl.GetQueryObjectuiv(query, GL_QUERY_RESULT, &passed);
    gl.DeleteQueries(1, &query);
    return passed;
}

Result<DrawList> draw_list_of(const Context& context, const Program& program, const Variant& variant,
                              const DrawnScene& scene) {
    return make_draw_list(context, program, variant.interface, scene.objects,
                          raster::with_plain_textures(variant.interface, scene.values),
                          viewed_from(scene.view));
}

Result<Program> linked_program(const Context& context, const Variants& variants, const Key& key) {
    GOBO_TRY(Program program, link_program(context, variants.stages_of(key)));
    set_bindings(context, program, variants.at(key).interface);
    return program;
}

Result<TimedGroup> time_variants(const Context& context, const Family& family, const Variants& variants,
                                 const std::vector<Key>& keys, const DrawnScene& scene, int rounds) {
    constexpr int kFewSlices = 32;
    constexpr int kManySlices = 160;
    constexpr int kMostAttempts = 3;  // all is timed so many times at most, until the control holds
    GOBO_TRY(const Framebuffer small, make_framebuffer(context, 160, 120));
    GOBO_TRY(const Framebuffer large, make_framebuffer(context, 480, 360));
    GOBO_TRY(const Framebuffer tiny, make_framebuffer(context, 16, 12));
    const GladGLContext& gl = context.gl();
    const auto clear = [&](const Framebuffer& target) {
        target.bind();
        gl.ClearColor(0, 0, 0, 1);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.Finish();
    };
    // What draws in this thread is timed by its processor time, a GPU by a clock that a known load bears out.
    std::optional<ChosenClock> chosen;
    std::string renderer = context.renderer();
    if (!draws_in_calling_thread(renderer)) {
        GOBO_TRY(chosen, choose_clock(context));
        renderer += ", " + chosen->name;
    }
    const auto draw = [&](const DrawList& list, const Framebuffer& target) {
        clear(target);
        if (chosen) return Instant{chosen->clock([&] { list.draw(); }), 0};
        const Instant start = now();
        list.draw();
        gl.Finish();
        return now() - start;
    };
    const auto fragments_of = [&](const DrawList& list, const Framebuffer& target) {
        clear(target);
        return count_fragments(context, list);
    };
    // All keys have the same effects, so the same shadows.
    const DrawnScene shadowed = with_shadows(family, keys.front(), scene);
    const DrawnScene few = with_shadows(family, keys.front(), sphere_scene(family, kFewSlices, 16, 12));
    const DrawnScene many = with_shadows(family, keys.front(), sphere_scene(family, kManySlices, 16, 12));
    const double vertices = static_cast<double>(many.objects[0].mesh.positions.size()) -
                            static_cast<double>(few.objects[0].mesh.positions.size());
    std::vector<Key> with_control = keys;
    with_control.push_back(keys.front());
    std::vector<Timed> all;
    for (const Key& key : with_control) {
        GOBO_TRY(const Program program, linked_program(context, variants, key));
        GOBO_TRY(DrawList of_scene, draw_list_of(context, program, variants.at(key), shadowed));
        GOBO_TRY(DrawList of_few, draw_list_of(context, program, variants.at(key), few));
        GOBO_TRY(DrawList of_many, draw_list_of(context, program, variants.at(key), many));
        draw(of_scene, small);  // to warm up
        draw(of_few, tiny);
        all.push_back({std::move(of_scene), std::move(of_few), std::move(of_many)});
    }
    for (Timed& timed : all)
        timed.fragments = fragments_of(timed.scene, large) - fragments_of(timed.scene, small);
    TimedGroup group;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        for (Timed& timed : all) timed.fragment = timed.vertex = {};
        for (int round = 0; round < rounds; ++round) {
            for (const std::size_t i : order_of(all.size(), round)) {
                Timed& timed = all[i];
                add(draw(timed.scene, large) - draw(timed.scene, small), timed.fragments, timed.fragment);
                add(draw(timed.many, tiny) - draw(timed.few, tiny), vertices, timed.vertex);
            }
        }
        group = group_of(all, rounds, renderer);
        // By a clock that is not trusted nothing is ranked, as where the control fails.
        if (chosen && !chosen->is_trusted()) group.control.elapsed = 1;
        if (group.control.ranked(renderer) <= kLargestControl) break;
        if (chosen && !chosen->is_trusted()) break;
    }
    return group;
}

Result<double> draw_once(const Subject& subject, const StudyScene& scene, const Context& context,
                         const Key& key, int width, int height) {
    GOBO_TRY(DrawnScene drawn, draw_scene(subject.shipped, subject.family, scene, width, height));
    drawn = with_shadows(subject.family, key, std::move(drawn));
    GOBO_TRY(const Variants variants, load_variants(subject, {key}));
    GOBO_TRY(const Framebuffer framebuffer, make_framebuffer(context, width, height));
    GOBO_TRY(const Program program, linked_program(context, variants, key));
    GOBO_TRY(const DrawList list, draw_list_of(context, program, variants.at(key), drawn));
    framebuffer.bind();
    count_fragments(context, list);  // compiles, which is not to be counted
    CALLGRIND_START_INSTRUMENTATION;
    const double fragments = count_fragments(context, list);
    CALLGRIND_STOP_INSTRUMENTATION;
    return fragments;
}

Result<double> count_instructions(const DrawCommand& command, const std::string& key) {
    std::array<double, 2> instructions{};
    std::array<double, 2> fragments{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [width, height] = i == 0 ? std::pair{64, 48} : std::pair{160, 120};
        std::vector<std::string> whole = {"valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"};
        // Built without valgrind's headers, all that the process does is counted, which takes ten times as
        // long.
        if (GOBO_HAS_CALLGRIND != 0) whole.emplace_back("--instr-atstart=no");
        for (std::string& argument : command(key, width, height)) whole.push_back(std::move(argument));
        const auto text = printed_by(whole);
        const auto collected = text ? number_after(*text, "Collected :") : std::nullopt;
        const auto drawn = text ? number_after(*text, "fragments ") : std::nullopt;
        if (!collected || !drawn)
            return fail(Fault::file, fmt::format("callgrind counts nothing: {}", join(whole, " ")),
                        "install valgrind, or leave out --callgrind");
        instructions[i] = *collected;
        fragments[i] = *drawn;
    }
    return (instructions[1] - instructions[0]) / (fragments[1] - fragments[0]);
}

// Minimises the squares over weights that are not negative, one weight at a time: the problem is convex, and
// so small that this ends soon.
ByKind solve_for_prices(const std::vector<Weighing>& operations) {
    constexpr int kSweeps = 20000;
    // Where two kinds always come together, the least prices that explain the times are taken.
    constexpr double kRidge = 1e-6;
    double typical = 0;
    for (const Weighing& row : operations)
        typical += row.nanoseconds.median / static_cast<double>(operations.size());
    ByKind prices{};
    const auto improve = [&](std::size_t kind) {
        double slope = 0;
        double curvature = 0;
        for (const Weighing& row : operations) {
            double residual = row.nanoseconds.median;
            for (std::size_t other = 0; other < evaluate::kKinds; ++other)
                residual -= row.counts[other] * prices[other];
            // What takes hardly any time is noise: it counts as a tenth of the typical row.
            const double scale = 1 / (row.nanoseconds.median + typical / 10);
            const double count = row.counts[kind] * scale;
            slope += count * (residual * scale + count * prices[kind]);
            curvature += count * count;
        }
        if (curvature > 0) prices[kind] = std::max(0.0, slope / (curvature * (1 + kRidge)));
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) improve(kind);
    return prices;
}

Result<WeighingResult> weigh_operations(const FileSystem& shipped, const Context& context, int rounds,
                                        int jobs) {
    const std::string folder = "data/study/operations";
    const std::string path = folder + "/operations.toml";
    GOBO_TRY(const std::string text, shipped.read(path));
    GOBO_TRY(const Family family, read_family(text, path));
    SearchPath search;
    search.add(shipped, folder, folder + "/", false);
    const int operation = family.index_of("operation").value();
    const std::vector<std::string>& names = family.features[static_cast<std::size_t>(operation)].values;
    std::vector<Key> keys;  // of each operation, a few and many
    for (const std::string& name : names)
        for (const char* repeats : {"", "repeats=many "})
            keys.push_back(parse_key(family, fmt::format("{}operation={}", repeats, name)).value());
    GOBO_TRY(const Variants variants, load_variants({shipped, family, search, jobs}, keys));
    GOBO_TRY(const DrawnScene scene, draw_scene(shipped, family, default_plan(family).scenes.front()));
    GOBO_TRY(const ScenePoints points, find_points(family, variants.at(keys.front()), scene));
    // Where a program's code happens to lie changes its time by more than its rounds tell: so each is linked,
    // and timed, so many times, and the one whose median is the middle one counts.
    constexpr int kLinks = 3;
    WeighingResult result;
    std::vector<std::vector<Spread>> spreads(keys.size());
    for (int link = 0; link < kLinks; ++link) {
        GOBO_TRY(const TimedGroup group, time_variants(context, family, variants, keys, scene, rounds));
        result.control.elapsed = std::max(result.control.elapsed, group.control.elapsed);
        result.control.processor = std::max(result.control.processor, group.control.processor);
        for (std::size_t i = 0; i < keys.size(); ++i)
            spreads[i].push_back(group.timings[i].ranked().fragment);
    }
    for (std::vector<Spread>& own : spreads)
        std::sort(own.begin(), own.end(),
                  [](const Spread& a, const Spread& b) { return a.median < b.median; });
    for (std::size_t i = 0; i < names.size(); ++i) {
        GOBO_TRY(const ByKind few_counts, counts_of(points, variants.at(keys[2 * i])));
        GOBO_TRY(const ByKind many_counts, counts_of(points, variants.at(keys[2 * i + 1])));
        const Spread& few = spreads[2 * i][kLinks / 2];
        const Spread& many = spreads[2 * i + 1][kLinks / 2];
        Weighing& row = result.operations.emplace_back();
        row.operation = names[i];
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            row.counts[kind] = many_counts[kind] - few_counts[kind];
        row.nanoseconds = {std::max(0.0, many.median - few.median), std::max(0.0, many.low - few.high),
                           std::max(0.0, many.high - few.low)};
    }
    result.weights = weights_of(solve_for_prices(result.operations), context.renderer());
    return result;
}

}  // namespace gobo::study
