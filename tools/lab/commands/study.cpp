// gobo study: error against cost of every quality, as tables and as a report.
#include <array>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "budget/qualities.hpp"
#include "core/append_file.hpp"
#include "family/key.hpp"
#include "lab/commands/commands.hpp"
#include "lab/commands/study_files.hpp"
#include "lab/study/front.hpp"
#include "lab/study/report.hpp"

namespace gobo {
namespace {

struct StudyCommandOptions {
    CommonOptions common;
    std::string family;
    std::string folder;
    std::vector<std::string> effects;
    std::string backend = "osmesa";
    std::string weights_from;
    std::string plan;
    int rounds = study::kLeastRounds;
    bool quick = false;
    bool no_time = false;
    bool weigh = false;
    bool callgrind = false;
    std::string front;  ///< effects of a finished study to show
    std::string svg;
    std::string study;
    std::string draw;       ///< a key to draw once: what callgrind watches
    std::string draw_size;  ///< "160x120"
};

/// One line that is written over, on a terminal only.
study::Progress progress_on_terminal(bool is_quiet) {
    if (is_quiet || isatty(STDERR_FILENO) == 0) return [](std::string_view, std::size_t, std::size_t) {};
    return [](std::string_view what, std::size_t done, std::size_t total) {
        fmt::print(stderr, "\r\x1b[K");
        if (done < total) fmt::print(stderr, "{}/{} {}", done + 1, total, what);
        std::fflush(stderr);
    };
}

/// What made the report, for who reads it.
std::string command_line(const StudyCommandOptions& options) {
    std::string line = fmt::format("gobo study {} -o {}", options.family, options.folder);
    for (const std::string& effects : options.effects) line += fmt::format(" --effects '{}'", effects);
    if (options.quick) line += " --quick";
    if (options.no_time) line += " --no-time";
    if (options.rounds != study::kLeastRounds) line += fmt::format(" --rounds {}", options.rounds);
    if (!options.plan.empty()) line += " --plan " + options.plan;
    if (!options.weights_from.empty()) line += " --weights-from " + options.weights_from;
    return line;
}

Outcome show_front(const StudyCommandOptions& options, const World& world) {
    const Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const auto plan = load_plan(world, family->family, options.plan);
    if (!plan) return failed(plan.error());
    const Result<Key> key = parse_key(family->family, options.front);
    if (!key) return failed(key.error());
    const Key effects = effects_of(family->family, *key);
    const std::string shipped = fmt::format("data/study/{}.csv", family->family.name);
    const bool is_shipped = options.study.empty();
    const Result<std::string> csv =
        is_shipped ? world.shipped.read(shipped) : read_input(world, options.study);
    if (!csv) return failed(csv.error());
    const auto rows = study::read_rows(*csv, is_shipped ? shipped : options.study, family->family, effects);
    if (!rows) return failed(rows.error());
    if (options.svg.empty()) return {study::front_table(*rows), {}, {}};
    std::vector<const study::StudyRow*> all;
    for (const study::StudyRow& row : *rows) all.push_back(&row);
    const study::Chart chart =
        study::front_chart(family->family, plan->rate, all, key_text(family->family, effects));
    if (auto written = world.disk.write(options.svg, chart.svg()); !written) return failed(written.error());
    return {study::front_table(*rows), {}, options.svg};
}

Result<void> write_all(FileSystem& disk, const std::string& folder,
                       const std::map<std::string, std::string>& files) {
    for (const auto& [name, text] : files)
        if (const auto written = disk.write(folder + "/" + name, text); !written)
            return tl::unexpected(written.error());
    return {};
}

Result<Context> open_timing_context(const StudyCommandOptions& options) {
    const Result<Backend> backend = backend_of(options.backend);
    if (!backend) return tl::unexpected(backend.error());
    study::make_timings_repeatable();
    return open_context(*backend);
}

std::string control_text(double control) {
    return fmt::format("{:.1f} %{}", 100 * control,
                       control <= study::kLargestControl ? "" : ", more than 2 %: rank nothing by it");
}

Outcome weigh(const StudyCommandOptions& options, const World& world) {
    const Result<Context> context = open_timing_context(options);
    if (!context) return failed(context.error());
    const auto result = study::weigh_operations(world.shipped, *context, options.rounds, options.common.jobs);
    if (!result) return failed(result.error());
    std::string text = fmt::format("{}, {} rounds; A/A control: elapsed {}, processor {}\n",
                                   context->renderer(), options.rounds, control_text(result->control.elapsed),
                                   control_text(result->control.processor));
    for (const study::Weighing& row : result->operations)
        text += fmt::format("{:14}{:8.3f} ns ({:.3f} to {:.3f}) for {} repetitions\n", row.operation,
                            row.nanoseconds.median, row.nanoseconds.low, row.nanoseconds.high, 16);
    if (auto written =
            write_all(world.disk, options.folder, {{"weights.csv", study::weights_csv({result->weights})}});
        !written)
        return failed(written.error());
    return {text, {}, options.folder + "/weights.csv"};
}

study::Subject subject_of(const StudyCommandOptions& options, const World& world,
                          const LoadedFamily& family) {
    return {world.shipped, family.family, family.search, options.common.jobs};
}

study::TimeOptions time_options_of(const StudyCommandOptions& options, const World& world) {
    return {options.rounds, machine_name(world.disk), progress_on_terminal(options.common.quiet)};
}

Result<void> add_times(const StudyCommandOptions& options, const World& world, const LoadedFamily& family,
                       const study::Weights& weights, study::Journal& journal, study::Study& study) {
    GOBO_TRY(const Context context, open_timing_context(options));
    return study::add_times(subject_of(options, world, family), context, weights,
                            time_options_of(options, world), journal, study);
}

/// This program again, drawing a key once.
study::DrawCommand draw_command(const StudyCommandOptions& options) {
    std::array<char, 4096> self{};
    const ssize_t length = ::readlink("/proc/self/exe", self.data(), self.size() - 1);
    const std::string program(self.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    std::vector<std::string> command = {program,        "study",     options.family, "-o",
                                        options.folder, "--backend", options.backend};
    for (const std::string& folder : options.common.include_folders)
        command.insert(command.end(), {"-I", folder});
    if (!options.plan.empty()) command.insert(command.end(), {"--plan", options.plan});
    if (!options.common.library.empty()) command.insert(command.end(), {"--library", options.common.library});
    return [command](const std::string& key, int width, int height) {
        std::vector<std::string> whole = command;
        whole.insert(whole.end(), {"--draw", key, "--draw-size", fmt::format("{}x{}", width, height)});
        return whole;
    };
}

Outcome draw(const StudyCommandOptions& options, const World& world) {
    const Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const auto plan = load_plan(world, family->family, options.plan);
    if (!plan) return failed(plan.error());
    const Result<Key> key = parse_key(family->family, options.draw);
    if (!key) return failed(key.error());
    const Result<Context> context = open_timing_context(options);
    if (!context) return failed(context.error());
    int width = 160;
    int height = 120;
    std::sscanf(options.draw_size.c_str(), "%dx%d", &width, &height);
    const Result<double> fragments =
        study::draw_once(subject_of(options, world, *family), plan->scenes.front(), *context,
                         canonical(family->family, *key, "450"), width, height);
    if (!fragments) return failed(fragments.error());
    return {fmt::format("fragments {}\n", *fragments), {}, {}};
}

Result<std::map<std::string, std::string>> make_files(const StudyCommandOptions& options, const World& world,
                                                      const LoadedFamily& family,
                                                      const study::Weights& weights,
                                                      const study::Study& study) {
    const auto rows = study::rows_of(family.family, study, weights);
    auto maps = study::draw_heat_maps(subject_of(options, world, family), study.plan);
    if (!maps) return tl::unexpected(maps.error());
    const bool is_timed = !study.effects.empty() && study.effects.front().control.has_value();
    const std::string guards = "docs/data/guard_prices.csv";
    const study::ReportInput input{family.family,
                                   study,
                                   rows,
                                   weights,
                                   std::move(*maps),
                                   command_line(options),
                                   is_timed ? machine_name(world.disk) : "",
                                   world.shipped.is_file(guards) ? world.shipped.read(guards).value() : ""};
    auto files = study::make_report(world.shipped, input);
    if (!files) return files;
    (*files)["study.csv"] = study::study_csv(rows);
    (*files)["summary.csv"] = study::study_csv(study::summary_of(family.family, rows));
    (*files)["curves.csv"] = study::curves_csv(study.curves);
    (*files)["weights.csv"] = study::weights_csv({weights});
    return files;
}

Outcome run(const StudyCommandOptions& options, const World& world) {
    if (!options.front.empty()) return show_front(options, world);
    if (options.folder.empty())
        return failed(fail(Fault::usage, "--output is required",
                           "name the folder for index.html, the charts and the tables: -o study")
                          .value());
    if (options.weigh) return weigh(options, world);
    if (!options.draw.empty()) return draw(options, world);
    const Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const auto weights = load_weights(world, options.weights_from);
    if (!weights) return failed(weights.error());
    const auto plan = load_plan(world, family->family, options.plan);
    if (!plan) return failed(plan.error());
    study::StudyOptions study_options;
    study_options.plan = *plan;
    study_options.effects = options.effects;
    study_options.quick = options.quick;
    study_options.weights = *weights;
    study_options.progress = progress_on_terminal(options.common.quiet);
    study::Journal journal(world.disk, options.folder + "/measurements.jsonl", append_to_disk);
    const study::Subject subject = subject_of(options, world, *family);
    auto study = study::run_study(subject, study_options, journal);
    if (!study) return failed(study.error());
    if (!options.quick && !options.no_time)
        if (auto timed = add_times(options, world, *family, *weights, journal, *study); !timed)
            return failed(timed.error());
    if (options.callgrind)
        if (auto counted = study::add_instructions(subject, draw_command(options),
                                                   time_options_of(options, world), journal, *study);
            !counted)
            return failed(counted.error());
    const auto files = make_files(options, world, *family, *weights, *study);
    if (!files) return failed(files.error());
    if (auto written = write_all(world.disk, options.folder, *files); !written)
        return failed(written.error());
    return {study_summary(family->family, *study, *weights), {}, options.folder + "/index.html"};
}

}  // namespace

Command study_command(CLI::App& gobo) {
    auto options = std::make_shared<StudyCommandOptions>();
    CLI::App* app = gobo.add_subcommand("study", "Error against cost of every quality: tables and a report");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file")->required();
    app->add_option("-o,--output", options->folder, "Folder for index.html, the charts and the tables")
        ->type_name("DIR");
    app->add_option("--front", options->front,
                    "Print the front of these effects from a finished study, in six lines, and stop")
        ->type_name("KEY");
    app->add_option("--svg", options->svg, "With --front: its chart")->type_name("FILE");
    app->add_option("--study", options->study,
                    "With --front: a study.csv or summary.csv; by default the one that came with the family")
        ->type_name("FILE");
    app->add_option("--effects", options->effects,
                    "A combination of effects (repeatable); by default those of the plan")
        ->type_name("KEY")
        ->allow_extra_args(false);
    app->add_flag("--quick", options->quick, "Few effects, no times: a usable front in under a minute");
    app->add_flag("--no-time", options->no_time, "Errors and costs only: no renderer is needed");
    app->add_option("--rounds", options->rounds, "Interleaved rounds of timing")
        ->type_name("N")
        ->check(CLI::Range(study::kLeastRounds, 1000))
        ->capture_default_str();
    app->add_option("--backend", options->backend, "What is timed")
        ->type_name("osmesa|egl")
        ->capture_default_str();
    app->add_flag(
        "--callgrind", options->callgrind,
        "Count the instructions of a fragment too, for the last effects; needs valgrind and patience");
    app->add_option("--draw", options->draw)->group("");  // for what --callgrind runs
    app->add_option("--draw-size", options->draw_size)->group("");
    app->add_flag(
        "--weights", options->weigh,
        "Measure what an operation of each kind costs on this renderer, write weights.csv, and stop");
    app->add_option("--plan", options->plan,
                    "A TOML file that says what to measure; by default the one that came with the family")
        ->type_name("FILE");
    app->add_option("--weights-from", options->weights_from, "A weights.csv; by default the shipped one")
        ->type_name("FILE");
    add_common_options(*app, options->common);
    app->footer(
        "What is measured is kept in DIR/measurements.jsonl: a study that was interrupted goes on from "
        "there.\n\n"
        "Examples:\n"
        "  gobo study lit -o study\n"
        "  gobo study lit -o study --quick\n"
        "  gobo study lit -o study --no-time --effects 'point=2 specular=blinn' --effects 'fog=linear'\n"
        "  gobo study lit -o study --weights\n"
        "  gobo study lit --front 'directional=1 specular=blinn'");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
