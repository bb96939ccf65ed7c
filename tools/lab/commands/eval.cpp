// gobo eval: one invocation of a stage, in fp32 and fp64.
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/eval_report.hpp"
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
Result<evaluate::Program> program_of(const World& world, const Subject& subject, StageKind stage) {
    GOBO_TRY(const Validated validated,
             compile(world, subject, {.keep_spirv = true, .debug_information = true}));
    const Permutation& permutation = subject.composition.permutations.front();
    const int index = permutation.stages[stage];
    if (index < 0)
        return fail(Fault::input, fmt::format("there is no {} stage to evaluate", name_of(stage)),
                    "name its file, or state another 'stage' in the input file");
    return evaluate::decode(validated.stages[static_cast<std::size_t>(index)].spirv);
}

Result<Outcome> run(const EvalOptions& options, const World& world) {
    GOBO_TRY(const Subject subject, load_subject(world, options.names, options.stages, options.dialect));
    GOBO_TRY(const std::string text, read_input(world, options.inputs));
    GOBO_TRY(const auto inputs, evaluate::read_eval_inputs(text, options.inputs));
    const StageKind stage = inputs.stage == "vertex" ? StageKind::vertex : StageKind::fragment;
    GOBO_TRY(const evaluate::Program program, program_of(world, subject, stage));
    GOBO_TRY(const evaluate::Invocations invocations, evaluate::invocations_of(inputs, program));
    GOBO_TRY(const auto report, evaluate::evaluate_once(program, invocations, options.trace));
    // Of the lighting models, where the family is ours and reads nothing new.
    std::vector<verify::Answer> answers;
    if (!subject.are_files)
        answers = verify::ask_oracle(subject.family.family, subject.composition.permutations.front().key,
                                     stage, program, invocations)
                      .value_or(answers);
    const Diagnostics notes = evaluate::inputs_left_out(inputs, program);
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
    return {titles::kEval,
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
            "  albedo = [1, 1, 1, 1]   # the colour that every texture function answers"};
}

}  // namespace gobo
