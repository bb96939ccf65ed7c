// gobo study: error against cost of every quality, as tables and as a report.
#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "core/file_system.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "gobo/name_lists.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/cost/compile_on_chips.hpp"
#include "lab/cost/study_cycles.hpp"
#include "lab/study/chip_fronts.hpp"
#include "lab/study/qualities.hpp"
#include "lab/study/report.hpp"
#include "lab/study/rows.hpp"
#include "lab/study/worst_case.hpp"

namespace gobo {
namespace {

struct StudyCommandOptions {
    std::string family;
    std::string folder;
    study::StudyOptions study;  ///< as far as the command line has it
    int rounds = study::kLeastRounds;
    std::string backend = "osmesa";
    std::string weights_from;
    std::string plan;
    bool no_time = false;
    bool weigh = false;
    bool callgrind = false;
    std::vector<std::string> gpus;
    std::string driver;
    std::string front;   ///< effects of a finished study to show
    std::string fronts;  ///< a page of all fronts of a finished study
    std::string svg;
    std::string study_file;
    std::size_t worst = 0;  ///< points of each quality to search
    std::vector<std::string> mediump;
    std::string domain;     ///< a file of domains to search within
    std::string promises;   ///< a table of errors that are promised
    std::string draw;       ///< a key to draw once: what callgrind watches
    std::string draw_size;  ///< "160x120"
};

/// What made the report, for who reads it.
std::string command_line(const StudyCommandOptions& options) {
    std::string line =
        fmt::format("gobo study {} -o {}", shell_word(options.family), shell_word(options.folder));
    for (const std::string& effects : options.study.effects) line += fmt::format(" --effects '{}'", effects);
    if (options.study.quick) line += " --quick";
    if (options.no_time) line += " --no-time";
    if (!options.gpus.empty()) line += fmt::format(" --gpu {}", join(options.gpus, ","));
    if (!options.driver.empty()) line += " --driver " + shell_word(options.driver);
    if (options.rounds != study::kLeastRounds) line += fmt::format(" --rounds {}", options.rounds);
    if (!options.plan.empty()) line += " --plan " + shell_word(options.plan);
    if (!options.weights_from.empty()) line += " --weights-from " + shell_word(options.weights_from);
    return line;
}

/// The processor's name; empty where the system does not tell.
std::string machine_name(const FileSystem& disk) {
    const Result<std::string> text = disk.read("/proc/cpuinfo");
    if (!text) return "";
    const std::size_t at = text->find("model name");
    if (at == std::string::npos) return "";
    const std::size_t colon = text->find(':', at);
    return std::string(trim(text->substr(colon + 1, text->find('\n', at) - colon - 1)));
}

Result<Context> open_timing_context(const StudyCommandOptions& options) {
    GOBO_TRY(const Backend backend, backend_of(options.backend));
    study::make_timings_repeatable();
    return open_context(backend);
}

/// The rows of the study that --study names, or of the one that came with the family.
Result<std::vector<study::StudyRow>> read_study(const StudyCommandOptions& options, const World& world,
                                                const Family& family, const Key* effects) {
    GOBO_TRY(const auto file,
             read_or_shipped(world, options.study_file, fmt::format("data/study/{}.csv", family.name)));
    return effects != nullptr ? study::read_rows(file.text, file.path, family, *effects)
                              : study::read_rows(file.text, file.path, family);
}

/// Without chips the front by additions; with chips all of them, side by side.
Result<Outcome> show_front(const StudyCommandOptions& options, const World& world) {
    GOBO_TRY(const LoadedFamily family, load_family(world, options.family));
    GOBO_TRY(const auto plan, load_plan(world, family.family, options.plan));
    GOBO_TRY(const Key key, parse_key(family.family, options.front));
    const Key effects = effects_of(family.family, key);
    GOBO_TRY(const auto rows, read_study(options, world, family.family, &effects));
    std::vector<const study::StudyRow*> all;
    for (const study::StudyRow& row : rows) all.push_back(&row);
    const std::string title = key_text(family.family, effects);
    if (options.gpus.empty()) {
        const study::Chart chart = study::front_chart(family.family, plan.rate, all, title);
        if (!options.svg.empty()) GOBO_TRY_DO(world.disk.write(options.svg, chart.svg()));
        return Outcome{study::front_table(rows), {}, options.svg};
    }
    GOBO_TRY(const auto gpus, names_in("--gpu", options.gpus));
    GOBO_TRY(const auto measures, study::measures_of(rows, gpus));
    if (!options.svg.empty())
        GOBO_TRY_DO(
            world.disk.write(options.svg, study::fronts_svg(family.family, plan.rate, all, title, measures)));
    return Outcome{study::fronts_table(rows, measures), {}, options.svg};
}

/// How the ranks of weighted operations and of each chip's cycles agree, over all keys that have both.
std::string ranks_text(const std::vector<study::StudyRow>& rows,
                       const std::vector<study::Measure>& measures) {
    std::vector<std::string> texts;
    for (const study::Measure& measure : measures) {
        std::vector<double> operations;
        std::vector<double> cycles;
        for (const study::StudyRow& row : rows)
            if (const auto cost = measure.cost(row); cost && row.scene == kAllScenes) {
                operations.push_back(row.costs.total);
                cycles.push_back(*cost);
            }
        if (!measure.gpu.empty())
            texts.push_back(fmt::format("{} {:.2f} over {} keys", measure.gpu,
                                        study::rank_correlation(operations, cycles), cycles.size()));
    }
    return texts.empty() ? "" : "rank correlation of operations and cycles: " + join(texts, ", ") + "\n\n";
}

/// The page of all fronts, and what it says of values.
Result<Outcome> show_fronts(const StudyCommandOptions& options, const World& world) {
    GOBO_TRY(const LoadedFamily family, load_family(world, options.family));
    GOBO_TRY(const auto plan, load_plan(world, family.family, options.plan));
    GOBO_TRY(const auto rows, read_study(options, world, family.family, nullptr));
    GOBO_TRY(const auto gpus, names_in("--gpu", options.gpus));
    GOBO_TRY(const auto measures, study::measures_of(rows, gpus));
    GOBO_TRY_DO(
        world.disk.write(options.fronts, study::fronts_page(family.family, plan.rate, rows, measures)));
    return Outcome{
        fmt::format("{}\n{}{}", study::changed_places_table(family.family, rows, measures),
                    ranks_text(rows, measures), study::values_table(family.family, rows, measures)),
        {},
        options.fronts};
}

std::string control_text(double control) {
    return fmt::format("{:.1f} %{}", 100 * control,
                       control <= study::kLargestControl ? "" : ", more than 2 %: rank nothing by it");
}

Result<Outcome> weigh(const StudyCommandOptions& options, const World& world) {
    GOBO_TRY(const Context context, open_timing_context(options));
    GOBO_TRY(const auto result,
             study::weigh_operations(world.shipped, context, options.rounds, world.jobs()));
    std::string text = fmt::format("{}, {} rounds; A/A control: elapsed {}, processor {}\n",
                                   context.renderer(), options.rounds, control_text(result.control.elapsed),
                                   control_text(result.control.processor));
    for (const study::Weighing& row : result.operations)
        text += fmt::format("{:14}{:8.3f} ns ({:.3f} to {:.3f}) for {} repetitions\n", row.operation,
                            row.nanoseconds.median, row.nanoseconds.low, row.nanoseconds.high, 16);
    const std::string path = options.folder + "/weights.csv";
    GOBO_TRY_DO(world.disk.write(path, study::weights_csv({result.weights})));
    return Outcome{text, {}, path};
}

Result<std::vector<Key>> effects_named(const Family& family, const std::vector<std::string>& texts) {
    std::vector<Key> effects;
    for (const std::string& text : texts) {
        GOBO_TRY(const Key key, parse_key(family, text));
        effects.push_back(effects_of(family, key));
    }
    return effects;
}

/// The effects that are asked for, by default the plan's.
Result<std::vector<Key>> effects_to_search(const StudyCommandOptions& options, const Family& family,
                                           const study::StudyPlan& plan) {
    const auto& planned = options.study.quick ? plan.quick : plan.effects;
    return effects_named(family, options.study.effects.empty() ? planned : options.study.effects);
}

/// Promises to be tried, and what they are about.
struct PromisesToTry {
    std::vector<study::Promise> promises;
    std::vector<Key> keys;        ///< of a manifest; nothing of a table, whose promises are about any effects
    std::vector<Domain> domains;  ///< of a manifest: narrower ones
};

/// Of a manifest that gobo build wrote where a budget chose: its keys, what is promised of them, and its
/// domain.
Result<PromisesToTry> promises_of_manifest(const Family& family, const std::string& text,
                                           const std::string& path) {
    const auto manifest = nlohmann::json::parse(text, nullptr, false);
    if (!manifest.is_object() || !manifest.contains("permutations") ||
        manifest.value("family", "") != family.name)
        return fail({path, 1, 0}, "", fmt::format("is no manifest of '{}'", family.name),
                    "name one that gobo build wrote, or a table of promises");
    PromisesToTry all;
    for (const auto& permutation : manifest["permutations"]) {
        if (!permutation.contains("promised_error")) continue;
        GOBO_TRY(const Key key, parse_key(family, permutation.value("key", "")));
        all.keys.push_back(key);
        all.promises.push_back({key_text(family, key), permutation.value("promised_error", 0.0)});
    }
    if (all.keys.empty())
        return fail({path, 1, 0}, "", "promises nothing: no budget chose its keys, or only by typical errors",
                    "build it with --max-error X");
    for (const auto& row : manifest.value("domain", nlohmann::json::array())) {
        Domain& domain = all.domains.emplace_back();
        domain.name = row.value("name", row.value("constraint", ""));
        domain.of_length = row.contains("length");
        const auto range = row.value(domain.of_length ? "length" : "range", std::vector<double>(2));
        domain.low = range.front();
        domain.high = range.back();
        domain.also = row.value("also", std::vector<double>());
        domain.last = row.value("last", std::vector<double>());
        domain.place = {path, 1, 0};
    }
    return all;
}

/// What budgets promise by a study of the keys with those effects; of all of them where none are named.
Result<PromisesToTry> promises_of_study(const Family& family, const std::string& text,
                                        const std::string& path, const std::vector<Key>& effects) {
    GOBO_TRY(const StudiedEffects studied, read_studied(text, path, family));
    PromisesToTry all;
    for (const auto& [of, keys] : studied) {
        if (!effects.empty() && std::ranges::find(effects, of) == effects.end()) continue;
        for (const StudiedKey& key : keys) {
            const auto promised = promised_error(key);
            if (!promised) continue;
            all.keys.push_back(key.key);
            all.promises.push_back({key_text(family, key.key), *promised});
        }
    }
    if (all.keys.empty())
        return fail({path, 1, 0}, "", "promises nothing of these effects",
                    "name effects that it has, or search it first: gobo study --worst N --study");
    return all;
}

/// The columns quality and error of a table, or what a manifest or a study promises.
Result<PromisesToTry> read_promises(const StudyCommandOptions& options, const World& world,
                                    const Family& family) {
    const std::string& path = options.promises;
    PromisesToTry all;
    if (path.empty()) return all;
    GOBO_TRY(const std::string text, read_input(world, path));
    if (path.ends_with(".json")) return promises_of_manifest(family, text, path);
    const CsvTable table = read_csv(text);
    if (table.column("error_worst")) {
        GOBO_TRY(const std::vector<Key> effects, effects_named(family, options.study.effects));
        return promises_of_study(family, text, path, effects);
    }
    const auto quality = table.column("quality");
    const auto error = table.column("error");
    if (!quality || !error)
        return fail({path, 1, 0}, "", "a table of promises has the columns 'quality' and 'error'");
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const auto number = number_from<double>(table.rows[row][*error]);
        if (!number) return fail_at_row(path, row, "'error' is not a number", "write what is promised: 0.01");
        all.promises.push_back({table.rows[row][*quality], *number});
    }
    return all;
}

/// The errors on the study's scenes by key text; nothing where there is no study.
std::map<std::string, double> errors_on_scenes(const StudyCommandOptions& options, const World& world,
                                               const Family& family) {
    std::map<std::string, double> errors;
    if (const auto rows = read_study(options, world, family, nullptr))
        for (const study::StudyRow& row : *rows)
            if (row.scene == kAllScenes) errors[row.key] = row.total.max;
    return errors;
}

/// What is searched: the keys that are promised something, those of a study that is named, or every single
/// choice.
Result<std::vector<Key>> keys_to_search(const StudyCommandOptions& options, const World& world,
                                        const Family& family, const PromisesToTry& promised) {
    if (!promised.keys.empty()) return promised.keys;
    std::vector<Key> keys;
    if (!options.study_file.empty()) {
        GOBO_TRY(const auto rows, read_study(options, world, family, nullptr));
        for (const study::StudyRow& row : rows)
            if (row.scene == kAllScenes) keys.push_back(parse_key(family, row.key).value());
        return keys;
    }
    GOBO_TRY(const auto plan, load_plan(world, family, options.plan));
    GOBO_TRY(const std::vector<Key> effects, effects_to_search(options, family, plan));
    for (const Key& of : effects) {
        keys.push_back(study::most_accurate(family, of));
        for (const study::Choice& choice : study::single_choices(family, of)) keys.push_back(choice.key);
        for (const Key& key : study::choices_of_es300(family, of)) keys.push_back(key);
    }
    return keys;
}

/// What a search of so many keys may write, told before it takes its time.
std::vector<std::string> files_of_search(const StudyCommandOptions& options, std::size_t keys) {
    std::vector<std::string> files = {options.folder + "/worst.csv"};
    if (!options.study_file.empty()) files.push_back(options.folder + "/study.csv");
    for (std::size_t number = 1; number <= keys; ++number)
        files.push_back(fmt::format("{}/{}.toml", options.folder, number));
    return files;
}

Result<Outcome> search_worst(const StudyCommandOptions& options, const World& world) {
    GOBO_TRY(LoadedFamily loaded, load_family(world, options.family));
    GOBO_TRY(const PromisesToTry promised, read_promises(options, world, loaded.family));
    GOBO_TRY_DO(narrow_domains(loaded.family, promised.domains));
    GOBO_TRY_DO(narrow_domains(world, loaded, options.domain));
    const Family& family = loaded.family;
    GOBO_TRY(const std::vector<Key> keys, keys_to_search(options, world, family, promised));
    if (!options.folder.empty()) GOBO_TRY_DO(world.refuse_inputs(files_of_search(options, keys.size())));
    const study::Subject subject{world.shipped, family, loaded.search, world.jobs()};
    GOBO_TRY(const auto cases, study::find_worst_cases(subject, keys, {options.worst}));
    const std::map<std::string, double> typical = errors_on_scenes(options, world, family);
    std::string text =
        fmt::format("{:<40} {:<32} {:>9} {:>9} {:>9}\n", "effects", "quality", "scenes", "worst", "rounding");
    Diagnostics diagnostics;
    std::size_t number = 0;
    for (const study::WorstCase& worst : cases) {
        const std::string key = key_text(family, worst.key);
        const auto on_scenes = typical.find(key);
        text += fmt::format("{:<40} {:<32} {:>9} {:>9.2g} {:>9.2g}\n", key_text(family, worst.effects),
                            study::quality_text(family, worst.key),
                            on_scenes == typical.end() ? "-" : fmt::format("{:.2g}", on_scenes->second),
                            worst.error, worst.rounding);
        if (options.folder.empty() || worst.error <= 0) continue;
        const std::string path = fmt::format("{}/{}.toml", options.folder, ++number);
        const std::string follow =
            fmt::format("gobo eval {} '{}' --inputs {}", shell_word(options.family), key, shell_word(path));
        append(diagnostics,
               keep_file(world, path,
                         evaluate::eval_file("fragment", worst.input, {follow}, evaluate::Digits::of_float)));
    }
    for (const auto& [promise, error] : study::broken_promises(family, promised.promises, cases))
        diagnostics.push_back(
            {.message = fmt::format("{} is promised to err by at most {:.3g}, and errs by {:.3g}",
                                    promise.quality, promise.error, error),
             .help = "promise more, or narrow the domain: --domain FILE"});
    if (!options.folder.empty()) {
        append(diagnostics,
               keep_file(world, options.folder + "/worst.csv", study::worst_case_csv(family, cases)));
        if (!options.study_file.empty()) {
            GOBO_TRY(const std::string studied, read_input(world, options.study_file));
            append(diagnostics, keep_file(world, options.folder + "/study.csv",
                                          csv_text(study::with_worst(read_csv(studied), family, cases))));
        }
    }
    return Outcome{text, std::move(diagnostics)};
}

/// What each name alone makes of the default quality where it is mediump.
Result<Outcome> search_mediump(const StudyCommandOptions& options, const World& world) {
    GOBO_TRY(LoadedFamily loaded, load_family(world, options.family));
    GOBO_TRY_DO(narrow_domains(world, loaded, options.domain));
    const Family& family = loaded.family;
    GOBO_TRY(const auto plan, load_plan(world, family, options.plan));
    GOBO_TRY(const std::vector<Key> keys, effects_to_search(options, family, plan));
    const study::Subject subject{world.shipped, family, loaded.search, world.jobs()};
    std::string text = fmt::format("{:<40} {:<20} {:>9} {:>9}\n", "effects", "mediump", "worst", "rounding");
    for (const std::string& name : split(join(options.mediump, ","), ',')) {
        GOBO_TRY(const auto cases,
                 study::find_worst_cases(subject, keys, {.points = options.worst, .mediump = name}));
        for (const study::WorstCase& worst : cases)
            text += fmt::format("{:<40} {:<20} {:>9.2g} {:>9.2g}\n", key_text(family, worst.effects), name,
                                worst.error, worst.rounding);
    }
    return Outcome{text};
}

/// This program again, drawing a key once.
study::DrawCommand draw_command(const StudyCommandOptions& options, const World& world) {
    std::error_code error;
    const std::string program = std::filesystem::read_symlink("/proc/self/exe", error).string();
    std::vector<std::string> command = {program,        "study",     options.family, "-o",
                                        options.folder, "--backend", options.backend};
    for (const std::string& folder : world.options.include_folders)
        command.insert(command.end(), {"-I", folder});
    if (!options.plan.empty()) command.insert(command.end(), {"--plan", options.plan});
    if (!world.options.library.empty()) command.insert(command.end(), {"--library", world.options.library});
    return [command](const std::string& key, int width, int height) {
        std::vector<std::string> whole = command;
        whole.insert(whole.end(), {"--draw", key, "--draw-size", fmt::format("{}x{}", width, height)});
        return whole;
    };
}

Result<Outcome> draw(const StudyCommandOptions& options, const World& world) {
    GOBO_TRY(const LoadedFamily family, load_family(world, options.family));
    GOBO_TRY(const auto plan, load_plan(world, family.family, options.plan));
    GOBO_TRY(const Key key, parse_key(family.family, options.draw));
    GOBO_TRY(const auto size, read_size(options.draw_size));
    GOBO_TRY(const Context context, open_timing_context(options));
    GOBO_TRY(
        const double fragments,
        study::draw_once({world.shipped, family.family, family.search, world.jobs()}, plan.scenes.front(),
                         context, canonical(family.family, key, "450"), size.first, size.second));
    return Outcome{fmt::format("fragments {}\n", fragments)};
}

std::string front_text(const Family& family, const study::EffectsResult& effects,
                       const study::Weights& weights) {
    const std::vector<StudiedKey> keys = study::studied_keys(effects, weights);
    std::size_t front = 0;
    const StudiedKey* cheapest = nullptr;
    const StudiedKey* best = nullptr;
    for (const StudiedKey& key : keys) {
        if (!key.on_front) continue;
        ++front;
        if (cheapest == nullptr || key.cost < cheapest->cost) cheapest = &key;
        if (best == nullptr || key.error < best->error) best = &key;
    }
    return fmt::format("{}: {} of {} measured, {} on the front, cost {} at error {} to cost {} at error {}\n",
                       key_text(family, effects.effects), keys.size(), effects.considered, front,
                       short_number(best->cost), short_number(best->error), short_number(cheapest->cost),
                       short_number(cheapest->error));
}

/// For each combination of effects its front's size and ends, the controls of timing, how cost goes with
/// time, and which choices are dominated everywhere.
std::string study_summary(const Family& family, const study::Study& study, const study::Weights& weights) {
    std::string text;
    for (const study::EffectsResult& effects : study.effects) text += front_text(family, effects, weights);
    text += study::times_summary(study, weights);
    for (const study::ChoiceSummary& choice : study::summarise_choices(family, study, weights))
        if (!choice.dominated_by.empty())
            text += fmt::format("{}={} is dominated everywhere by {}\n", choice.feature, choice.value,
                                choice.dominated_by);
    return text;
}

Result<Outcome> run(const StudyCommandOptions& options, const World& world) {
    if (!options.front.empty()) return show_front(options, world);
    if (!options.mediump.empty()) return search_mediump(options, world);
    if (options.worst > 0) return search_worst(options, world);
    if (!options.fronts.empty()) return show_fronts(options, world);
    if (options.folder.empty())
        return fail(Fault::usage, "--output is required",
                    "name the folder for index.html, the charts and the tables: -o study");
    if (options.weigh) return weigh(options, world);
    if (!options.draw.empty()) return draw(options, world);
    GOBO_TRY(const auto gpus, names_in("--gpu", options.gpus));
    GOBO_TRY(const auto chips, cost::chips_named(gpus));
    GOBO_TRY(const LoadedFamily loaded, load_family(world, options.family));
    const Family& family = loaded.family;
    study::StudyOptions study_options = options.study;
    GOBO_TRY(study_options.weights, load_weights(world, options.weights_from));
    GOBO_TRY(study_options.plan, load_plan(world, family, options.plan));
    const study::Weights& weights = study_options.weights;
    std::vector<std::string> tables;  // told before hours of measuring; beside them are pages and charts
    for (const char* name : {"/study.csv", "/summary.csv", "/curves.csv", "/weights.csv"})
        tables.push_back(options.folder + name);
    GOBO_TRY_DO(world.refuse_inputs(tables));
    study_options.progress = progress_on_terminal(world);
    study::Journal journal(world.disk, options.folder + "/measurements.jsonl", append_to_disk);
    const study::Subject subject{world.shipped, family, loaded.search, world.jobs()};
    GOBO_TRY(study::Study study, study::run_study(subject, study_options, journal));
    const study::TimeOptions time_options{options.rounds, machine_name(world.disk), study_options.progress};
    if (!options.study.quick && !options.no_time) {
        GOBO_TRY(const Context context, open_timing_context(options));
        GOBO_TRY_DO(study::add_times(subject, context, weights, time_options, journal, study));
    }
    if (options.callgrind)
        GOBO_TRY_DO(
            study::add_instructions(subject, draw_command(options, world), time_options, journal, study));
    const auto rows = study::rows_of(family, study, weights);
    GOBO_TRY(auto maps, study::draw_heat_maps(subject, study.plan));
    const bool is_timed = !study.effects.empty() && study.effects.front().control.has_value();
    const std::string guards = "docs/data/guard_prices.csv";
    const study::ReportInput input{family,
                                   study,
                                   rows,
                                   weights,
                                   std::move(maps),
                                   command_line(options),
                                   is_timed ? time_options.computer : "",
                                   world.shipped.is_file(guards) ? world.shipped.read(guards).value() : ""};
    GOBO_TRY(auto files, study::make_report(world.shipped, input));
    files["study.csv"] = study::study_csv(rows);
    files["summary.csv"] = study::study_csv(study::summary_of(family, rows));
    files["curves.csv"] = study::curves_csv(study.curves);
    files["weights.csv"] = study::weights_csv({weights});
    Diagnostics diagnostics;
    if (!chips.empty()) {
        const auto costs = costs_of_study(world, loaded, read_csv(files["study.csv"]), "study.csv", chips,
                                          options.driver, diagnostics);
        const CsvTable with_cycles = cost::with_cycles(read_csv(files["study.csv"]), costs);
        files["study.csv"] = csv_text(with_cycles);
        files["summary.csv"] = csv_text(cost::summary_of(with_cycles, read_csv(files["summary.csv"])));
        GOBO_TRY(const auto with_chips, study::read_rows(files["study.csv"], "study.csv", family));
        GOBO_TRY(const auto measures, study::measures_of(with_chips, {}));
        files["fronts.html"] = study::fronts_page(family, study.plan.rate, with_chips, measures);
    }
    Outcome outcome{study_summary(family, study, weights), std::move(diagnostics),
                    options.folder + "/index.html"};
    for (auto& [name, text] : files) outcome.files.push_back({options.folder + "/" + name, std::move(text)});
    return outcome;
}

}  // namespace

Command study_command() {
    const auto options = std::make_shared<StudyCommandOptions>();
    return {
        titles::kStudy,
        {family_argument(options->family),
         {"-o,--output", "DIR", "Folder for index.html, the charts and the tables", &options->folder},
         {"--front", "KEY", "Print the front of these effects from a finished study, in six lines, and stop",
          &options->front},
         {"--svg", "FILE", "With --front: its chart", &options->svg},
         {"--fronts", "FILE",
          "Write the fronts of a finished study as a page, by llvmpipe and by chips one above another; print "
          "which "
          "choices change places, and stop",
          &options->fronts},
         {"--study", "FILE",
          "With --front and --fronts: a study.csv or summary.csv; by default the one that came with the "
          "family. With --worst its keys are searched, and -o gets it with their worst errors in a column "
          "more",
          &options->study_file},
         {"--worst", "N",
          "Instead, search N points of the domain for the worst error of each quality's values beyond "
          "rounding, "
          "beside that on the study's scenes; with -o its input, for gobo eval",
          &options->worst, between(1, 1e12)},
         {"--mediump",
          "NAME,...",
          "With --worst: instead of qualities, each of these varyings and variables of pieces alone declared "
          "mediump, in GLSL ES 3.00 with 16-bit floats",
          &options->mediump,
          {.needs = "--worst"}},
         {"--promises", "FILE",
          "With --worst: a manifest that gobo build --max-error wrote, a study, or a CSV table of quality "
          "and "
          "error; promises that the search breaks are errors",
          &options->promises},
         {"--domain", "FILE",
          "With --worst: a file whose [domain] is narrower than the family's, or a scene for what it holds",
          &options->domain},
         {"--effects", "KEY", "A combination of effects; by default those of the plan",
          &options->study.effects},
         {"--quick", "", "Few effects, no times: a usable front in under a minute", &options->study.quick},
         {"--no-time", "", "Errors and costs only: no renderer is needed", &options->no_time},
         {"--rounds", "N", "Interleaved rounds of timing", &options->rounds,
          between(study::kLeastRounds, 1000)},
         {"--backend", "osmesa|egl", "What is timed", &options->backend},
         {"--gpu", "A,B,...",
          "Chips, as gobo cost has them: their cycles and fronts are columns of the tables too, and "
          "fronts.html "
          "shows them; with --front and --fronts those to show",
          &options->gpus},
         driver_option(options->driver),
         {"--callgrind", "",
          "Count the instructions of a fragment too, for the last effects; needs valgrind, some 15 s each",
          &options->callgrind},
         {"--draw", "KEY", "", &options->draw, kHidden},  // for what --callgrind runs
         {"--draw-size", "WxH", "", &options->draw_size, kHidden},
         {"--weights", "",
          "Measure what an operation of each kind costs on this renderer, write weights.csv, and stop",
          &options->weigh},
         {"--plan", "FILE",
          "A TOML file that says what to measure; by default the one that came with the family",
          &options->plan},
         {"--weights-from", "FILE", "A weights.csv; by default the shipped one", &options->weights_from}},
        {},
        "  gobo study lit -o study\n"
        "  gobo study lit -o study --quick\n"
        "  gobo study lit -o study --no-time --effects 'point=2 specular=blinn' --effects 'fog=linear'\n"
        "  gobo study lit -o study --weights\n"
        "  gobo study lit --front 'directional=1 specular=blinn'\n"
        "  gobo study lit --worst 100000 --effects 'spot=1' -o worst",
        [options](const World& world) { return run(*options, world); },
        "What is measured is kept in DIR/measurements.jsonl: a study that was interrupted goes on from "
        "there."};
}

}  // namespace gobo
