// gobo cost: what permutations cost on GPUs, as the compilers of their drivers estimate it.
#include <algorithm>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "gobo/name_lists.hpp"
#include "gobo/shard_text.hpp"
#include "lab/commands/cost_pipelines.hpp"
#include "lab/cost/baseline.hpp"
#include "lab/cost/study_cycles.hpp"

namespace gobo {
namespace {

using json = nlohmann::ordered_json;

/// The stages of the shipped family's plainest key: a driver that fails on them has no figures.
Result<cost::Pipeline> plainest_pair(const World& world) {
    GOBO_TRY(const LoadedFamily family, load_family(world, "lit"));
    GOBO_TRY(const std::vector<Key> keys,
             select(family.family, Selection{.keys = {{"default"}}}, name_of(family.dialect)));
    GOBO_TRY(Composition composition, compose_keys(family, keys));
    GOBO_TRY(const Validated validated, compile(world, family, composition, {.keep_spirv = true}));
    return pipeline_of(composition, validated, composition.permutations.front());
}

Result<Outcome> list_chips(const CostCommandOptions& options, const World& world) {
    GOBO_TRY(const cost::Pipeline plainest, plainest_pair(world));
    const auto answers =
        cost::compile_on_chips(world.disk, cost::chips(), {plainest}, compile_options(options, world));
    const bool has_driver =
        std::any_of(answers.begin(), answers.end(), [](const auto& answer) { return answer; });
    if (!has_driver) return tl::unexpected(answers.front().error());
    CsvTable table{{"gpu", "architecture", "sold_as", "driver"}, {}};
    json list = json::array();
    std::string text = fmt::format("{:<10} {:<13} {:<18} {}\n", "GPU", "architecture", "such as", "known to");
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const cost::Chip& chip = cost::chips()[i];
        const bool is_known = answers[i].has_value();
        const bool compiles = is_known && answers[i]->pipelines.front();
        const std::string driver = compiles ? answers[i]->driver : "";
        table.rows.push_back(
            {std::string(chip.name), std::string(chip.architecture), std::string(chip.sold_as), driver});
        list.push_back({{"gpu", chip.name},
                        {"architecture", chip.architecture},
                        {"sold_as", chip.sold_as},
                        {"driver", compiles ? json(driver) : json()}});
        text += fmt::format("{:<10} {:<13} {:<18} {}\n", chip.name, chip.architecture, chip.sold_as,
                            compiles   ? driver
                            : is_known ? fmt::format("no use: {} {}", answers[i]->driver,
                                                     answers[i]->pipelines.front().error())
                                       : "-");
    }
    if (options.csv) return Outcome{csv_text(table)};
    if (options.json) return Outcome{json{{"gpus", std::move(list)}}.dump(2) + "\n"};
    return Outcome{text,
                   {},
                   "more chips: fetch a newer Mesa's drivers into a folder with tools/fetch_mesa.sh "
                   "(installed: share/gobo/tools) and name it with "
                   "--driver"};
}

/// The names of the pieces of all stages.
std::vector<std::string> pieces_of(const Composition& composition, const Permutation& permutation) {
    std::vector<std::string> names;
    for (const int stage : permutation.stages.values)
        for (const int piece : stage < 0 ? std::vector<int>() : composition.stage(stage).pieces) {
            const std::string& name = composition.piece(piece).name;
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    return names;
}

std::string pieces_text(const std::vector<std::string>& pieces, const std::vector<std::string>& others,
                        const std::string& key) {
    std::vector<std::string> own;
    for (const std::string& piece : pieces)
        if (std::find(others.begin(), others.end(), piece) == others.end()) own.push_back(piece);
    return own.empty() ? "" : fmt::format("only in '{}': {}\n", key, join(own, ", "));
}

/// How the figures of each permutation differ from those of the first.
std::string differences(const CostCommandOptions& options, const Subject& subject,
                        const std::vector<cost::ChipCost>& costs) {
    const Composition& composition = subject.composition;
    const Permutation& first = composition.permutations.front();
    const std::string before = text_of(options, subject, first);
    const auto pieces_before = pieces_of(composition, first);
    std::string text;
    for (const Permutation& permutation : composition.permutations) {
        const std::string after = text_of(options, subject, permutation);
        if (after == before) continue;
        if (!text.empty()) text += '\n';
        const auto pieces = pieces_of(composition, permutation);
        text += fmt::format(
            "'{}' against '{}'\n{}{}{}", after, before, pieces_text(pieces, pieces_before, after),
            pieces_text(pieces_before, pieces, before), cost::difference_text(costs, before, after));
    }
    return text;
}

/// The keys with the one that they are compared with before them.
Result<void> put_first(Subject& subject, const std::string& against) {
    if (subject.are_files)
        return fail(Fault::usage, "--against compares keys of a family, and files have none",
                    "cost both sets of files with --csv and compare the tables, or use --baseline");
    GOBO_TRY(std::vector<Key> keys,
             select(subject.family.family, Selection{.keys = {{against}}}, name_of(subject.family.dialect)));
    for (const Permutation& permutation : subject.composition.permutations)
        if (permutation.key != keys.front()) keys.push_back(permutation.key);
    GOBO_TRY(subject.composition, compose_keys(subject.family, keys));
    const std::vector<Permutation>& permutations = subject.composition.permutations;
    const auto kind = [](const Permutation& permutation) {
        return std::pair(is_costed(permutation.stages), permutation.stages[StageKind::compute] >= 0);
    };
    for (const Permutation& permutation : permutations)
        if (kind(permutation) != kind(permutations.front()))
            return fail(Fault::usage,
                        fmt::format("--against: '{}' and '{}' are of programs that have other stages",
                                    key_text(subject.family.family, keys.front()),
                                    key_text(subject.family.family, permutation.key)),
                        "name a key of the same program");
    return {};
}

/// An error where --update would replace what is no baseline: a name that was meant for something else.
Result<void> refuse_other_file(const std::string& path) {
    const DiskFileSystem disk;
    if (!disk.is_file(path)) return {};
    GOBO_TRY(const std::string text, disk.read(path));
    if (trim(text).empty() || cost::is_baseline(read_csv(text))) return {};
    return fail(Fault::usage,
                fmt::format("'{}' would be written over, but is no table that --update wrote", path),
                "name another file, or remove it");
}

Result<Outcome> hold_to_baseline(const World& world, const CostCommandOptions& options,
                                 const std::vector<cost::ChipCost>& costs, Diagnostics diagnostics) {
    if (options.update) {
        if (exit_status(diagnostics) != 0)
            return tl::unexpected(std::move(diagnostics));  // it would lack rows
        const DiskFileSystem disk;                          // world.disk does not write over what was read
        const std::string path = disk.real_path(options.baseline);  // the file that a link leads to
        const CsvTable table = cost::to_table(costs);
        const std::size_t lost = cost::rows_lost(read_csv(disk.read(path).value_or("")), table);
        GOBO_TRY(const bool is_new, world.disk.write(path, csv_text(table)));
        std::string what = is_new ? "" : " (unchanged)";
        if (lost > 0) what = fmt::format(" (rows gone, which were not measured now: {})", lost);
        return Outcome{{}, std::move(diagnostics), options.baseline + what};
    }
    const Result<std::string> text = read_input(world, options.baseline);
    if (!text) return with_help(text.error(), "make it with --update");
    GOBO_TRY(const auto comparison,
             cost::compare_with_baseline(costs, read_csv(*text), options.baseline, options.tolerance));
    append(diagnostics, comparison.diagnostics);
    return Outcome{fmt::format("{} stages compared with {}, {} grown by more than {} %\n", comparison.stages,
                               options.baseline, comparison.grown, short_number(options.tolerance)),
                   std::move(diagnostics)};
}

/// The study's table with cycles.
Result<Outcome> cost_study(const World& world, const CostCommandOptions& options,
                           const std::vector<cost::Chip>& chips) {
    if (options.names.size() != 1)
        return fail(Fault::usage, "--study goes with one family",
                    "name it: gobo cost lit --study study.csv --gpu navi21");
    if (const std::string_view option = first_given(options); !option.empty())
        return fail(Fault::usage, fmt::format("--study has keys of its own, and {} chooses others", option),
                    "leave it out");
    GOBO_TRY(const LoadedFamily family, load_family(world, options.names.front()));
    GOBO_TRY(const std::string text, read_input(world, options.study));
    const CsvTable study = read_csv(text);
    for (const std::string_view column : cost::kStudyColumns)
        if (!study.column(column))
            return fail({options.study, 1, 0}, "",
                        fmt::format("is not a study.csv: it has no column '{}'", column),
                        fmt::format("make one: gobo study {} -o FOLDER", family.name));
    Diagnostics diagnostics;
    const auto costs =
        costs_of_study(world, family, study, options.study, chips, options.driver, diagnostics);
    return Outcome{csv_text(cost::with_cycles(study, costs)), std::move(diagnostics)};
}

/// An error where shader files are no pipeline that drivers are asked about.
Result<void> refuse_other_files(const StageNumbers& stages) {
    if (is_costed(stages)) return {};
    const std::string help =
        "name a file of each of those two: gobo cost game.vert game.frag --gpu navi21; or a compute stage";
    for (const StageNames& stage : kStages)
        if ((lies_between(stage.kind) || stage.kind == StageKind::compute) && stages[stage.kind] >= 0)
            return fail(
                Fault::usage,
                fmt::format("gobo cost compiles a vertex and a fragment stage alone, and here is a {} "
                            "stage",
                            stage.name),
                help);
    const StageKind missing = stages[StageKind::vertex] < 0 ? StageKind::vertex : StageKind::fragment;
    return fail(Fault::usage,
                fmt::format("there is no {} stage, and drivers compile both together", name_of(missing)),
                help);
}

Result<Outcome> run(const CostCommandOptions& options, const World& world) {
    GOBO_TRY(const auto gpus, names_in("--gpu", options.gpus));
    if (gpus == std::vector<std::string>{"list"}) return list_chips(options, world);
    GOBO_TRY(const std::vector<cost::Chip> chips, cost::chips_named(gpus));
    if (options.names.empty())
        return fail(Fault::usage, "there is nothing to cost",
                    "name a family, or shader files: gobo cost lit");
    if (options.update) GOBO_TRY_DO(refuse_other_file(options.baseline));
    if (!options.study.empty()) return cost_study(world, options, chips);
    if (options.specialized) return compare_specialized(world, options, chips);
    GOBO_TRY(Subject subject, load_subject(world, options.names, options.stages, options.dialect, &options));
    // Of more shards than keys the last have none, and gobo merge wants a table of each.
    const bool is_shard = !options.shard.empty() && (options.json || options.csv);
    Diagnostics diagnostics = warn_of_no_keys(subject.composition, "there is nothing to cost");
    if (!diagnostics.empty() && !is_shard) return Outcome{{}, std::move(diagnostics)};
    if (subject.are_files) GOBO_TRY_DO(refuse_other_files(subject.composition.permutations.front().stages));
    // Of a family with passes of other stages the rest is costed.
    const auto left_out = std::erase_if(subject.composition.permutations, [](const Permutation& permutation) {
        return !is_costed(permutation.stages);
    });
    if (subject.composition.permutations.empty() && left_out > 0)
        return fail(Place{subject.family.family.path}, "",
                    "gobo cost compiles a vertex and a fragment stage or a compute stage, and no key of the "
                    "selection "
                    "has those alone",
                    "name keys of other programs by --where");
    if (!options.against.empty()) GOBO_TRY_DO(put_first(subject, options.against));
    GOBO_TRY(Validated validated, compile(world, subject, {.keep_spirv = true}));
    Pipelines pipelines = pipelines_of(options, subject, validated);
    append(diagnostics, validated.diagnostics);
    if (left_out > 0)
        diagnostics.push_back(
            {.severity = Severity::warning,
             .message = fmt::format(
                 "{} keys are left out: gobo cost compiles a vertex and a fragment stage or a compute stage",
                 left_out),
             .help = "name those that have no other stages by --where"});
    append(diagnostics, pipelines.errors);
    const auto costs = costs_of(world, options, subject, pipelines, chips, diagnostics);
    if (!options.baseline.empty()) return hold_to_baseline(world, options, costs, std::move(diagnostics));
    std::string text;
    if (!options.against.empty()) {
        text = differences(options, subject, costs);
        if (subject.composition.permutations.size() == 1)
            diagnostics.push_back({.severity = Severity::note,
                                   .message = fmt::format(
                                       "--against names the key itself, '{}': they are the same",
                                       text_of(options, subject, subject.composition.permutations.front()))});
    } else if (options.json)
        text = text_of_shard(cost::to_json(costs, options.isa).dump(2) + "\n", options.shard,
                             subject.family.run);
    else if (options.csv)
        text = text_of_shard(csv_text(cost::to_table(costs)), options.shard, subject.family.run);
    else if (options.cycles)
        text = cost::cycles_text(costs);
    else
        text = options.isa ? cost::assembly_text(costs) : cost::to_text(costs);
    return Outcome{std::move(text), std::move(diagnostics)};
}

}  // namespace

Option driver_option(std::string& driver) {
    return {"--driver", "FOLDER|FILE",
            "A folder into which Mesa's packages were unpacked, as tools/fetch_mesa.sh does, or a Vulkan "
            "driver by its "
            "name or path; by default those installed",
            &driver};
}

Command compile_pipelines_command() {
    const auto library = std::make_shared<std::string>();
    Command command = {{cost::kServeCommand, "Compile with a Vulkan driver what standard input asks for"},
                       {{"LIBRARY", "FILE", "The driver", library.get(), kRequired}}};
    command.run = [library](const World&) -> Result<Outcome> {
        cost::serve_pipelines(*library);
        return Outcome{};
    };
    command.hidden = true;
    return command;
}

Command cost_command() {
    const auto options = std::make_shared<CostCommandOptions>();
    return {
        titles::kCost,
        {{"NAMES", "FAMILY|FILES...", "A family, or shader files (.vert and .frag, or .comp; .vert.glsl ...)",
          &options->names},
         stages_option(options->stages),
         dialect_option(options->dialect),
         {"--gpu", "A,B,...",
          "Chips, such as navi21,vega10; list prints those that this machine's driver knows", &options->gpus,
          kRequired},
         {"--against",
          "KEY",
          "How the figures of each key differ from those of this one",
          &options->against,
          {.excludes = "--isa --cycles --json --csv"}},
         {"--baseline",
          "FILE",
          "Compare with a table that was kept: what has grown is an error",
          &options->baseline,
          {.excludes = "--against --isa --cycles --json --csv"}},
         {"--tolerance",
          "PERCENT",
          "How much figures may grow",
          &options->tolerance,
          {.least = 0, .needs = "--baseline"}},
         {"--update", "", "Write the table instead", &options->update, {.needs = "--baseline"}},
         {"--study",
          "FILE",
          "Print this study.csv with cycles and fronts of the chips, for gobo build --max-error --gpu",
          &options->study,
          {.excludes = "--dialect --against --baseline --isa --cycles --json"}},
         {"--specialized",
          "",
          "Compile each key with its counts as specialisation constants too: what assembly differs, and how "
          "many "
          "modules and bytes that saves",
          &options->specialized,
          {.excludes = "--study --against --baseline --isa --cycles --json --csv"}},
         {"--isa",
          "",
          "Print the assembly of every stage; with --json beside its figures",
          &options->isa,
          {.excludes = "--cycles --csv"}},
         {"--cycles",
          "",
          "Print cycles only: a row for each key and stage, a column for each chip",
          &options->cycles,
          {.excludes = "--json --csv"}},
         {"--json", "", "Print JSON", &options->json, {.excludes = "--csv"}},
         {"--csv", "", "Print CSV, with instructions by kind", &options->csv},
         keep_option(options->folder, "the SPIR-V of stages that a driver crashes on"),
         driver_option(options->driver)},
        {selection_options(*options)},
        "  gobo cost lit --cover 2 --gpu polaris10,vega10,navi21\n"
        "  gobo cost lit --key 'point=1 specular=blinn' --gpu navi21 --isa\n"
        "  gobo cost lit --key 'point=2 light_sum=compensated' --against point=2 --gpu navi21\n"
        "  gobo cost lit --cover 2 --specialized --gpu navi21\n"
        "  gobo cost game.vert game.frag --gpu navi21\n"
        "  gobo cost blur.comp --gpu navi21\n"
        "  gobo cost game.vert game.frag --gpu navi21 --dialect vulkan\n"
        "  gobo cost lit --gpu navi21 --baseline costs.csv --update\n"
        "  gobo cost --gpu list",
        [options](const World& world) { return run(*options, world); },
        "Figures are a compiler's static estimates: no time was measured, and no GPU is needed. Cycles are "
        "those of "
        "64 vertices, fragments or invocations; of NVIDIA's chips they are gobo's own estimate from the "
        "driver's "
        "assembly. Where "
        "'loop' stands, the compiler guesses how often it runs."};
}

}  // namespace gobo
