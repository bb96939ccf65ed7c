// scene_gain SCENE...: what permutations gain over an ubershader, on the same scenes, in one run.
//
// Each scene is drawn by the ubershader with switches, by the one with light-count loops, and by the
// permutations that its draws call for, twice: the two must come out alike, or times mean nothing. Time per
// fragment is the slope between two sizes, so that what a draw costs by itself drops out; rivals take turns.
// Operations are counted by the evaluator and repeat exactly; weights, in additions, come from a study.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/render/render.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "lab/study/measure.hpp"
#include "scene/read_scene.hpp"
#include "software_scene.hpp"
#include "uber_values.hpp"

namespace gobo::scene {
namespace {

constexpr int rounds = 20;
constexpr std::array widths = {160, 480};
constexpr int counted_width = 120;

/// Stops with what is wrong: a benchmark has nothing better to do.
template <class Value>
Value must(Result<Value> result) {
    if (result) return std::move(*result);
    for (const Diagnostic& diagnostic : result.error()) std::fputs(to_text(diagnostic).c_str(), stderr);
    std::exit(1);
}

struct Shipped {
    explicit Shipped(const std::string& name) {
        const std::string folder = std::string(GOBO_SOURCE_DIR) + "/";
        const FindFamily find = [&](const std::string& base) -> Result<FamilyText> {
            const std::string path = folder + "templates/" + base + ".toml";
            return FamilyText{must(files.read(path)), path};
        };
        const std::string own_folder = name == "uber" ? "tests/ubershader" : "templates";
        const std::string path = folder + own_folder + "/" + name + ".toml";
        family = must(read_family(must(files.read(path)), path, find));
        for (const std::string& part : {own_folder, std::string("shader_lib"), std::string("templates")})
            search.add(files, folder + part, part + "/", false);
    }
    DiskFileSystem files;
    Family family;
    SearchPath search;
};

/// One way of drawing the scene.
struct Rival {
    std::string name;
    SceneShaders shaders;
    std::vector<Object> objects;
    std::vector<double> nanoseconds;  ///< per fragment, one for each round
    double link_milliseconds = 0;
};

Rival specialised(const std::string& name, const Shipped& lit, const Scene& scene,
                  const std::vector<Draw>& draws) {
    Rival rival{name, must(shaders_for_draws(lit.family, lit.search, draws, {}, Dialect::own, 1)), {}, {}};
    rival.objects = objects_of(scene, rival.shaders);
    return rival;
}

Rival ubershader(const std::string& name, const Shipped& lit, const Shipped& uber, const Scene& scene,
                 const std::vector<Draw>& draws, UberLights lights) {
    const auto keys = must(keys_for_draws(lit.family, draws, {}, "450"));
    std::vector<std::optional<Key>> uber_keys;
    std::vector<Object> objects;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        uber_keys.emplace_back();
        objects.emplace_back();
        if (!keys[i]) continue;
        uber_keys.back() = uber_key(uber.family, lit.family, keys[i]->key, lights);
        objects.back() = object_of(scene, draws[i]);
        objects.back().values =
            uber_values(uber.family, lit.family, keys[i]->key, std::move(objects.back().values));
    }
    return {name,
            must(shaders_of(uber.family, uber.search, draws, uber_keys, Dialect::own, 1)),
            std::move(objects),
            {}};
}

/// Of the processor, not the wall: llvmpipe draws in this thread, and others' work must not count.
double milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

SceneView view_at(const Scene& scene, const std::vector<Draw>& draws, int width) {
    const auto camera = first_camera(scene);
    if (camera) return *view_of_camera(scene, *camera, width, 3 * width / 4);
    return view_of_all(draws, {0.5, 0.4, 1}, width, 3 * width / 4);
}

/// A rival ready to be drawn at one size.
struct Ready {
    Framebuffer framebuffer;
    SceneDrawing drawing;
    double fragments = 0;  ///< pixels that show something
};

Ready make_ready(const Context& context, const Scene& scene, const std::vector<Draw>& draws,
                 const Rival& rival, const std::vector<RenderValue>& values, int width) {
    const SceneView view = view_at(scene, draws, width);
    Ready ready{must(make_framebuffer(context, view.width, view.height)),
                must(SceneDrawing::make(context, rival.shaders, rival.objects, values, view))};
    ready.framebuffer.bind();
    ready.framebuffer.clear(view.background);
    ready.drawing.draw();
    for (const float depth : ready.framebuffer.read_depth().values)
        if (depth < 1) ++ready.fragments;
    return ready;
}

double draw_milliseconds(const Context& context, const Ready& ready) {
    ready.framebuffer.bind();
    ready.framebuffer.clear({0, 0, 0, 1});
    context.gl().Finish();
    const double start = milliseconds();
    ready.drawing.draw();
    context.gl().Finish();
    return milliseconds() - start;
}

/// Compiling and linking all programs, in a driver that has not seen them.
double link_milliseconds(const Context& context, const Rival& rival) {
    const double start = milliseconds();
    const Composition& composition = rival.shaders.composition;
    for (const Permutation& permutation : composition.permutations)
        static_cast<void>(
            must(link_program(context, {stage_text(composition, permutation.stages[StageKind::vertex]),
                                        stage_text(composition, permutation.stages[StageKind::fragment])})));
    return milliseconds() - start;
}

void time_rivals(const Context& context, const Scene& scene, const std::vector<Draw>& draws,
                 const std::vector<RenderValue>& values, std::vector<Rival>& rivals) {
    std::vector<std::vector<Ready>> ready(rivals.size());
    for (std::size_t i = 0; i < rivals.size(); ++i) {
        rivals[i].link_milliseconds = link_milliseconds(context, rivals[i]);
        for (const int width : widths)
            ready[i].push_back(make_ready(context, scene, draws, rivals[i], values, width));
    }
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < rivals.size(); ++i) {
            const double small = draw_milliseconds(context, ready[i][0]);
            const double large = draw_milliseconds(context, ready[i][1]);
            rivals[i].nanoseconds.push_back(1e6 * (large - small) /
                                            (ready[i][1].fragments - ready[i][0].fragments));
        }
    }
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

/// What shading a fragment executes, on average.
struct Work {
    double operations = 0;  ///< each counted as 1
    double weighted = 0;    ///< in additions
};

Work work_of(const Scene& scene, const std::vector<Draw>& draws, const Rival& rival,
             const std::vector<RenderValue>& values, const std::optional<study::Weights>& weights) {
    const auto programs = must(software_programs(rival.shaders));
    const auto picture = must(draw_in_software(rival.shaders, programs, rival.objects, values,
                                               view_at(scene, draws, counted_width), true));
    Work work;
    for (const auto count : picture.operations)
        work.operations += static_cast<double>(count) / static_cast<double>(picture.fragments);
    if (weights)
        work.weighted =
            study::weighted(picture.operations, *weights) / static_cast<double>(picture.fragments);
    return work;
}

/// Those of the renderer that draws, else the first.
std::optional<study::Weights> read_weights(const std::string& path, const std::string& renderer) {
    if (path.empty()) return std::nullopt;
    const DiskFileSystem files;
    const std::vector<study::Weights> all = must(study::read_weights(must(files.read(path)), path));
    const auto own = std::find_if(
        all.begin(), all.end(), [&](const study::Weights& weights) { return weights.renderer == renderer; });
    return own == all.end() ? all.front() : *own;
}

std::size_t source_bytes(const Composition& composition) {
    std::size_t bytes = 0;
    for (const Stage& stage : composition.stages) bytes += source_of(composition, stage).size();
    return bytes;
}

std::size_t spirv_words(const SceneShaders& shaders) {
    std::size_t words = 0;
    for (const auto& stage : shaders.validated.stages) words += stage.spirv.size();
    return words;
}

void run_scene(const std::string& path, const Shipped& lit, const Shipped& uber, const Context& context,
               const std::optional<study::Weights>& weights) {
    const DiskFileSystem files;
    const Scene scene = must(read_scene(files, path));
    const auto draws = required_effects(scene, eye_of_cameras(scene), {});
    std::vector<Rival> rivals;
    rivals.push_back(ubershader("uber, switches", lit, uber, scene, draws, UberLights::switched));
    rivals.push_back(ubershader("uber, loops", lit, uber, scene, draws, UberLights::looped));
    rivals.push_back(specialised("permutations", lit, scene, draws));
    rivals.push_back(specialised("permutations again", lit, scene, draws));
    const auto values = values_beside_scene(lit.family.render);
    time_rivals(context, scene, draws, values, rivals);
    const double base_time = quantile(rivals[2].nanoseconds, 0.5);
    const Work base = work_of(scene, draws, rivals[2], values, weights);
    fmt::print("\n{}\n", path.substr(path.rfind('/') + 1));
    fmt::print("{:<20}{:>9}{:>7}{:>10}{:>7}{:>18}{:>7}{:>10}{:>9}{:>10}{:>10}\n", "", "op/frag", "x",
               "weighted", "x", "ns/frag (IQR)", "x", "programs", "GLSL kB", "SPIR-V kB", "link ms");
    for (const Rival& rival : rivals) {
        const Work work = work_of(scene, draws, rival, values, weights);
        const double median = quantile(rival.nanoseconds, 0.5);
        fmt::print("{:<20}{:>9.0f}{:>7.2f}{:>10}{:>7}{:>18}{:>7.2f}{:>10}{:>9.1f}{:>10.1f}{:>10.1f}\n",
                   rival.name, work.operations, work.operations / base.operations,
                   weights ? fmt::format("{:.0f}", work.weighted) : "-",
                   weights ? fmt::format("{:.2f}", work.weighted / base.weighted) : "-",
                   fmt::format("{:.0f} ({:.0f}-{:.0f})", median, quantile(rival.nanoseconds, 0.25),
                               quantile(rival.nanoseconds, 0.75)),
                   median / base_time, rival.shaders.composition.permutations.size(),
                   static_cast<double>(source_bytes(rival.shaders.composition)) / 1e3,
                   static_cast<double>(4 * spirv_words(rival.shaders)) / 1e3, rival.link_milliseconds);
    }
    const double again = quantile(rivals[3].nanoseconds, 0.5) / base_time;
    if (std::abs(again - 1) > 0.02)
        fmt::print(
            "the permutations' two times differ by {:.1f} %: the times rank nothing closer than that\n",
            100 * std::abs(again - 1));
}

void run(const std::vector<std::string>& scenes, const std::string& weights_path) {
    const Shipped lit("lit");
    const Shipped uber("uber");
    const auto context = must(open_context(Backend::osmesa));
    const auto weights = read_weights(weights_path, context.renderer());
    fmt::print("{}; {} interleaved rounds, medians of processor time; weights: {}\n", context.renderer(),
               rounds, weights ? weights->renderer : "none");
    for (const std::string& path : scenes) run_scene(path, lit, uber, context, weights);
}

}  // namespace
}  // namespace gobo::scene

int main(int argc, char** argv) {
    std::vector<std::string> scenes;
    std::string weights;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument.starts_with("--weights=")) {
            weights = argument.substr(10);
        } else {
            scenes.push_back(argument);
        }
    }
    if (scenes.empty()) {
        std::fputs("usage: scene_gain [--weights=WEIGHTS.csv] SCENE.gltf...\n", stderr);
        return 2;
    }
    // One thread, and no program from an earlier run: both would be measured otherwise.
    setenv("LP_NUM_THREADS", "0", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    gobo::scene::run(scenes, weights);
    return 0;
}
