// gobo eval: one invocation of a stage, in fp32 and fp64.
#include <nlohmann/json.hpp>

#include "lab/commands/commands.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/eval_report.hpp"
#include "lab/verify/expectation.hpp"

namespace gobo {
namespace {

struct EvalOptions {
    std::vector<std::string> names;  ///< FAMILY KEY, or files
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
    const int index = stage == StageKind::vertex ? permutation.vertex : permutation.fragment;
    if (index < 0)
        return fail(Fault::input, fmt::format("there is no {} stage to evaluate", name_of(stage)),
                    "name its file, or state another 'stage' in the input file");
    return evaluate::decode(validated.stages[static_cast<std::size_t>(index)].spirv);
}

/// Quotes the pieces, whose paths are the files of the trace.
evaluate::SourceLine quote_pieces(const Composition& composition) {
    return [&composition](const Place& place) -> std::string {
        for (const Piece& piece : composition.pieces)
            if (piece.path == place.file) return std::string(line_of(piece, place.line));
        return {};
    };
}

/// {"oracle": [{"output", "exact", "fp32_bound"}]} beside what the report says.
nlohmann::ordered_json with_answers(nlohmann::ordered_json json, const std::vector<verify::Answer>& answers) {
    for (const verify::Answer& answer : answers)
        json["oracle"].push_back(
            {{"output", answer.output}, {"exact", answer.value}, {"fp32_bound", answer.float_error}});
    return json;
}

Result<Outcome> run(const EvalOptions& options, const World& world) {
    GOBO_TRY(const Subject subject, load_subject(world, options.names, options.dialect));
    GOBO_TRY(const std::string text, read_input(world, options.inputs));
    GOBO_TRY(const auto inputs, evaluate::read_eval_inputs(text, options.inputs));
    const StageKind stage = inputs.stage == "vertex" ? StageKind::vertex : StageKind::fragment;
    GOBO_TRY(const evaluate::Program program, program_of(world, subject, stage));
    GOBO_TRY(const evaluate::Invocations invocations, evaluate::invocations_of(inputs, program));
    GOBO_TRY(const auto report, evaluate::evaluate_once(program, invocations, options.trace));
    std::vector<verify::Answer>
        answers;  // of the lighting models, where the family is ours and reads nothing new
    if (!subject.are_files)
        answers = verify::ask_oracle(subject.family.family, subject.composition.permutations.front().key,
                                     stage, program, invocations)
                      .value_or(answers);
    return Outcome{options.json ? with_answers(evaluate::to_json(report), answers).dump(2) + "\n"
                                : evaluate::to_text(report, quote_pieces(subject.composition)) +
                                      verify::to_text(answers),
                   evaluate::inputs_left_out(inputs, program)};
}

}  // namespace

Command eval_command() {
    const auto options = std::make_shared<EvalOptions>();
    return {titles::kEval,
            {subject_argument(options->names),
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
