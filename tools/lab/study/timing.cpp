#include "lab/study/timing.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numeric>

#include "family/key.hpp"
#include "lab/render/framebuffer.hpp"
#include "lab/study/scene_shadows.hpp"
#include "lab/verify/random.hpp"
#include "lab/verify/render_feed.hpp"

namespace gobo::study {
namespace {

constexpr int kFewSlices = 32;
constexpr int kManySlices = 160;
/// So many times at most all is timed, until the control holds.
constexpr int kMostAttempts = 3;

/// Nanoseconds by both clocks.
struct Instant {
    double elapsed = 0;
    double processor = 0;
};

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

/// What is drawn to.
struct Targets {
    Framebuffer small;
    Framebuffer large;
    Framebuffer tiny;
};

Result<Targets> make_targets(const Context& context) {
    auto small = make_framebuffer(context, 160, 120);
    if (!small) return tl::unexpected(small.error());
    auto large = make_framebuffer(context, 480, 360);
    if (!large) return tl::unexpected(large.error());
    auto tiny = make_framebuffer(context, 16, 12);
    if (!tiny) return tl::unexpected(tiny.error());
    return Targets{std::move(*small), std::move(*large), std::move(*tiny)};
}

/// A linked program with what it draws.
struct Timed {
    std::unique_ptr<Program> program;  ///< the lists hold its address
    std::optional<DrawList> scene;
    std::optional<DrawList> few;
    std::optional<DrawList> many;
    std::vector<double> fragment_elapsed, fragment_processor;  ///< slopes, one a round
    std::vector<double> vertex_elapsed, vertex_processor;

    void forget() {
        for (auto* slopes : {&fragment_elapsed, &fragment_processor, &vertex_elapsed, &vertex_processor})
            slopes->clear();
    }
};

ViewedObject viewed(const View& view) {
    ViewedObject object;
    object.view = view.camera.view();
    object.projection = view.camera.projection(static_cast<double>(view.width) / view.height);
    object.viewport = {view.width, view.height};
    return object;
}

class Stopwatch {
  public:
    Stopwatch(const Context& context, Targets targets) : context_(context), targets_(std::move(targets)) {}

    Result<Timed> prepare(const Variants& variants, const Key& key, const DrawnScene& scene,
                          const DrawnScene& few, const DrawnScene& many) const {
        const Permutation& permutation = variants.composition.permutations[variants.index.at(key)];
        auto program = link_program(context_, {stage_text(variants.composition, permutation.vertex),
                                               stage_text(variants.composition, permutation.fragment)});
        if (!program) return tl::unexpected(program.error());
        Timed timed;
        timed.program = std::make_unique<Program>(std::move(*program));
        const Interface& interface = variants.at(key).interface;
        set_bindings(context_, *timed.program, interface);
        for (const auto& [list, drawn] :
             {std::pair{&timed.scene, &scene}, std::pair{&timed.few, &few}, std::pair{&timed.many, &many}}) {
            auto made =
                make_draw_list(context_, *timed.program, interface, drawn->objects,
                               verify::with_plain_textures(interface, drawn->values), viewed(drawn->view));
            if (!made) return tl::unexpected(made.error());
            list->emplace(std::move(*made));
        }
        return timed;
    }

    /// Counts the fragments that one more pixel of size costs, and warms up.
    [[nodiscard]] double fragments_between(const Timed& timed) const {
        return count(*timed.scene, targets_.large) - count(*timed.scene, targets_.small);
    }

    void round(Timed& timed, double fragments, double vertices) const {
        const Instant fragment = draw(*timed.scene, targets_.large) - draw(*timed.scene, targets_.small);
        const Instant vertex = draw(*timed.many, targets_.tiny) - draw(*timed.few, targets_.tiny);
        timed.fragment_elapsed.push_back(fragment.elapsed / fragments);
        timed.fragment_processor.push_back(fragment.processor / fragments);
        timed.vertex_elapsed.push_back(vertex.elapsed / vertices);
        timed.vertex_processor.push_back(vertex.processor / vertices);
    }

    void warm_up(const Timed& timed) const {
        draw(*timed.scene, targets_.small);
        draw(*timed.few, targets_.tiny);
    }

  private:
    void clear(const Framebuffer& target) const {
        target.bind();
        context_.gl().ClearColor(0, 0, 0, 1);
        context_.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        context_.gl().Finish();
    }

    Instant draw(const DrawList& list, const Framebuffer& target) const {
        clear(target);
        const Instant start = now();
        list.draw();
        context_.gl().Finish();
        return now() - start;
    }

    [[nodiscard]] double count(const DrawList& list, const Framebuffer& target) const {
        clear(target);
        return count_fragments(context_, list);
    }

    Context context_;
    Targets targets_;
};

double off(const Spread& first, const Spread& second) {
    return second.median > 0 ? std::abs(first.median / second.median - 1) : 1;
}

Timing timing_of(const Timed& timed, int rounds, const std::string& renderer) {
    return {{spread_of(timed.fragment_elapsed), spread_of(timed.vertex_elapsed)},
            {spread_of(timed.fragment_processor), spread_of(timed.vertex_processor)},
            rounds,
            renderer};
}

/// The last one timed is the second copy of the first.
TimedGroup group_of(const std::vector<Timed>& all, int rounds, const std::string& renderer) {
    TimedGroup group;
    for (const Timed& timed : all) group.timings.push_back(timing_of(timed, rounds, renderer));
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
    verify::Random random(static_cast<std::uint64_t>(round) + 1);
    for (std::size_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.whole(0, static_cast<int>(i) - 1))]);
    return order;
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

double ranked_control(const Control& control, const std::string& renderer) {
    return draws_in_calling_thread(renderer) ? control.processor : control.elapsed;
}

Result<TimedGroup> time_variants(const Context& context, const Family& family, const Variants& variants,
                                 const std::vector<Key>& keys, const DrawnScene& scene, int rounds) {
    auto targets = make_targets(context);
    if (!targets) return tl::unexpected(targets.error());
    const Stopwatch stopwatch(context, std::move(*targets));
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
        Result<Timed> timed = stopwatch.prepare(variants, key, shadowed, few, many);
        if (!timed) return tl::unexpected(timed.error());
        stopwatch.warm_up(*timed);
        all.push_back(std::move(*timed));
    }
    std::vector<double> fragments;
    for (const Timed& timed : all) fragments.push_back(stopwatch.fragments_between(timed));
    TimedGroup group;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
        for (int round = 0; round < rounds; ++round)
            for (const std::size_t i : order_of(all.size(), round))
                stopwatch.round(all[i], fragments[i], vertices);
        group = group_of(all, rounds, context.renderer());
        if (ranked_control(group.control, context.renderer()) <= kLargestControl) break;
        for (Timed& timed : all) timed.forget();
    }
    return group;
}

}  // namespace gobo::study
