#include "lab/study/draw_clock.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lab/render/program.hpp"
#include "lab/render/render.hpp"
#include "lab/study/statistics.hpp"

namespace gobo::study {
namespace {

/// A triangle over the whole target.
constexpr const char* kVertex =
    "#version 330\n"
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, "
    "1.0); "
    "}\n";
/// Work that no compiler leaves out, on every fragment the same.
constexpr const char* kFragment =
    "#version 330\n"
    "out vec4 color;\n"
    "void main() {\n"
    "    float x = gl_FragCoord.x * 0.001;\n"
    "    for (int i = 0; i < 64; ++i) x = sin(x) + 0.5;\n"
    "    color = vec4(x * 1e-6);\n"
    "}\n";

constexpr int kSide = 128;     // pixels
constexpr double kLoad = 2e6;  // nanoseconds, at least, of the least load
constexpr int kMostLayers = 1 << 16;
constexpr int kRounds = 7;

}  // namespace

double load_error(const std::vector<LoadTime>& times) {
    const auto count = static_cast<double>(times.size());
    double load = 0;
    double time = 0;
    for (const LoadTime& one : times) {
        load += one.load / count;
        time += one.nanoseconds / count;
    }
    double covariance = 0;
    double variance = 0;
    double least = times.empty() ? 0 : times.front().load;
    double greatest = least;
    for (const LoadTime& one : times) {
        covariance += (one.load - load) * (one.nanoseconds - time);
        variance += (one.load - load) * (one.load - load);
        least = std::min(least, one.load);
        greatest = std::max(greatest, one.load);
    }
    if (times.size() < 3 || !(covariance > 0) || !(variance > 0)) return 1;
    const double slope = covariance / variance;
    double worst = 0;
    for (const LoadTime& one : times)
        worst = std::max(worst, std::abs(one.nanoseconds - time - slope * (one.load - load)));
    return std::min(worst / (slope * (greatest - least)), 1.0);
}

DrawClock timer_query(const Context& context) {
    return [context](const std::function<void()>& draw) {
        const GladGLContext& gl = context.gl();
        GLuint query = 0;
        gl.GenQueries(1, &query);
        gl.BeginQuery(GL_TIME_ELAPSED, query);
        draw();
        gl.EndQuery(GL_TIME_ELAPSED);
        GLuint64 nanoseconds = 0;
        gl.GetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);  // waits for it
        gl.DeleteQueries(1, &query);
        return static_cast<double>(nanoseconds);
    };
}

DrawClock finished_draw(const Context& context) {
    return [context](const std::function<void()>& draw) {
        context.gl().Finish();
        const auto start = std::chrono::steady_clock::now();
        draw();
        context.gl().Finish();
        return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
    };
}

Result<double> known_load_error(const Context& context, const DrawClock& clock) {
    GOBO_TRY(const Program program,
             link_program(context, {stage_text(StageKind::vertex, "load.vert", kVertex),
                                    stage_text(StageKind::fragment, "load.frag", kFragment)}));
    GOBO_TRY(const Framebuffer target, make_framebuffer(context, kSide, kSide));
    const GladGLContext& gl = context.gl();
    GLuint nothing = 0;
    gl.GenVertexArrays(1, &nothing);
    gl.BindVertexArray(nothing);
    gl.UseProgram(program.id());
    target.bind();
    gl.Disable(GL_DEPTH_TEST);
    // Layers are added up, so that none can be left out.
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    const auto draw = [&](int layers) { gl.DrawArraysInstanced(GL_TRIANGLES, 0, 3, layers); };
    const DrawClock finished = finished_draw(context);
    int layers = 1;
    while (layers < kMostLayers && finished([&] { draw(layers); }) < kLoad) layers *= 2;
    std::vector<LoadTime> times;
    for (int load = 1; load <= 4; ++load) {
        std::vector<double> rounds;
        for (int round = 0; round < kRounds; ++round) rounds.push_back(clock([&] { draw(load * layers); }));
        times.push_back({static_cast<double>(load), spread_of(std::move(rounds)).median});
    }
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
    gl.BindVertexArray(0);
    gl.DeleteVertexArrays(1, &nothing);
    return load_error(times);
}

Result<ChosenClock> choose_clock(const Context& context) {
    ChosenClock query{timer_query(context), "timer query"};
    GOBO_TRY(query.error, known_load_error(context, query.clock));
    if (query.is_trusted()) return query;
    ChosenClock finished{finished_draw(context), "glFinish"};
    GOBO_TRY(finished.error, known_load_error(context, finished.clock));
    return finished;
}

}  // namespace gobo::study
