#include "lab/study/timing.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numeric>

#include "lab/raster/random.hpp"
#include "lab/raster/raster_object.hpp"

namespace gobo::study {
namespace {

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

/// Nanoseconds for one fragment or vertex, by both clocks, one a round.
struct Laps {
    std::vector<double> elapsed;
    std::vector<double> processor;

    void add(const Instant& lap, double count) {
        elapsed.push_back(lap.elapsed / count);
        processor.push_back(lap.processor / count);
    }
};

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
        group.timings.push_back({{spread_of(timed.fragment.elapsed), spread_of(timed.vertex.elapsed)},
                                 {spread_of(timed.fragment.processor), spread_of(timed.vertex.processor)},
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

}  // namespace

const Slopes& Timing::ranked() const {
    return draws_in_calling_thread(renderer) ? processor : elapsed;
}

double Control::ranked(const std::string& renderer) const {
    return draws_in_calling_thread(renderer) ? processor : elapsed;
}

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
    const auto draw = [&](const DrawList& list, const Framebuffer& target) {
        clear(target);
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
                timed.fragment.add(draw(timed.scene, large) - draw(timed.scene, small), timed.fragments);
                timed.vertex.add(draw(timed.many, tiny) - draw(timed.few, tiny), vertices);
            }
        }
        group = group_of(all, rounds, context.renderer());
        if (group.control.ranked(context.renderer()) <= kLargestControl) break;
    }
    return group;
}

}  // namespace gobo::study
