// gobo eval: one invocation of a stage, in fp32 and fp64.
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/eval_report.hpp"
#include "lab/sanitize/machine.hpp"
#include "lab/verify/expectation.hpp"

namespace gobo {
namespace {

struct EvalOptions {
    std::vector<std::string> names;  ///< FAMILY KEY, or files
    std::vector<std::string> stages;
    std::string inputs;
    std::string dialect;
    bool trace = false;
    bool json = false;
};

/// The stage, ready to be evaluated.
Result<evaluate::Program> program_of(const World& world, Subject& subject, StageKind stage,
                                     std::uint32_t longest_array) {
    GOBO_TRY(const Validated validated,
             compile(world, subject, {.keep_spirv = true, .debug_information = true}));
    const Permutation& permutation = subject.composition.permutations.front();
    const int index = permutation.stages[stage];
    if (index < 0) {
        GOBO_TRY_DO(refuse_other_stages(subject.family.family, subject.composition, "gobo eval evaluates"));
        return fail(Fault::input, fmt::format("there is no {} stage to evaluate", name_of(stage)),
                    "name its file, or state another 'stage' in the input file");
    }
    return evaluate::decode(validated.stages[static_cast<std::size_t>(index)].spirv,
                            {std::max(evaluate::kUnstatedLength, longest_array), evaluate::Widths::up_to_64});
}

/// Which function each subroutine uniform of shader files is, where nobody said.
Diagnostics functions_chosen(const Family& family, const Key& key) {
    Diagnostics notes;
    for (std::size_t i = 0; i < key.size() && key == default_key(family); ++i) {
        const Feature& feature = family.features[i];
        notes.push_back(note_in(
            "", fmt::format("the subroutine uniform '{}' is '{}'; name another behind the "
                            "files: {}={}",
                            feature.name, feature.values.front(), feature.name, feature.values.back())));
    }
    return notes;
}

std::vector<std::string> machine_names() {
    std::vector<std::string> names;
    for (const sanitize::MachineRow& row : sanitize::kMachineRows) names.emplace_back(row.name);
    return names;
}

Result<Outcome> run(const EvalOptions& options, const World& world) {
    GOBO_TRY(Subject subject,
             load_subject(world, options.names, options.stages, options.dialect, nullptr, Counts::literal));
    GOBO_TRY(const std::string text, read_input(world, options.inputs));
    GOBO_TRY(const auto inputs, evaluate::read_eval_inputs(text, options.inputs));
    const StageKind stage = inputs.stage == "vertex" ? StageKind::vertex : StageKind::fragment;
    GOBO_TRY(const evaluate::Program program,
             program_of(world, subject, stage, evaluate::longest_array(inputs)));
    GOBO_TRY(const evaluate::Invocations invocations, evaluate::invocations_of(inputs, program));
    evaluate::EvalOptions how{options.trace, {}, inputs.pixel};
    if (const std::string& name = inputs.machine.text; !name.empty()) {
        const auto machine = sanitize::machine_named(name);
        if (!machine)
            return fail(inputs.machine.place, inputs.machine.quoted_line,
                        fmt::format("there is no arithmetic '{}'", name), suggestion(name, machine_names()));
        how.arithmetic = sanitize::options_of(*machine);
    }
    if (inputs.pixel >= invocations.count) how.invocation = 0;  // the quad's pixels are all alike
    GOBO_TRY(const auto report, evaluate::evaluate_once(program, invocations, how));
    // Of the lighting models, where the family is ours and reads nothing new.
    std::vector<verify::Answer> answers;
    // They know textures of one colour.
    const bool has_patterns = std::ranges::any_of(
        inputs.samplers, [](const auto& sampler) { return sampler.first.ends_with(".texels"); });
    if (!subject.are_files && invocations.count == 1 && !has_patterns)
        answers = verify::ask_oracle(subject.family.family, subject.composition.permutations.front().key,
                                     stage, program, invocations)
                      .value_or(answers);
    Diagnostics notes = evaluate::inputs_left_out(inputs, program);
    if (subject.are_files)
        append(notes, functions_chosen(subject.family.family, subject.composition.permutations.front().key));
    if (options.json) {
        nlohmann::ordered_json json = evaluate::to_json(report);
        for (const verify::Answer& answer : answers)
            json["oracle"].push_back(
                {{"output", answer.output}, {"exact", answer.value}, {"fp32_bound", answer.float_error}});
        return Outcome{json.dump(2) + "\n", notes};
    }
    const auto quote = [&](const Place& place) { return one_line(quoted_line(subject.composition, place)); };
    return Outcome{evaluate::to_text(report, quote) + verify::to_text(answers), notes};
}

}  // namespace

Command eval_command() {
    const auto options = std::make_shared<EvalOptions>();
    return {
        titles::kEval,
        {subject_argument(options->names),
         stages_option(options->stages),
         {"--inputs", "FILE.toml", "The stage, its inputs, uniforms and samplers", &options->inputs,
          kRequired},
         {"--trace", "", "Print every operation with its place and values", &options->trace},
         {"--json", "", "Print JSON", &options->json},
         dialect_option(options->dialect)},
        {},
        "  gobo eval lit 'fog=linear point=3' --inputs point.toml\n"
        "  gobo eval game.frag --inputs point.toml --trace",
        [options](const World& world) { return run(*options, world); },
        "An input file:\n"
        "  stage = \"fragment\"\n"
        "  [inputs]\n"
        "  normal = [0, 0, 1]\n"
        "  [uniforms]\n"
        "  \"PointLights.lights[0].position\" = [0, 1, 2, 1]\n"
        "  [samplers]\n"
        "  albedo = [1, 1, 1, 1]   # the colour that every texture function answers\n"
        "An input with four values is of the four pixels of a quad, and 'pixel = 2' says which is printed; "
        "'machine = \"flushed\"' evaluates as gobo sanitize --machine does."};
}

}  // namespace gobo
