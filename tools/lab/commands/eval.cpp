// gobo eval: one invocation of a stage, in fp32 and fp64.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gobo/subject.hpp"
#include "lab/commands/commands.hpp"
#include "lab/evaluate/eval_inputs.hpp"
#include "lab/evaluate/eval_report.hpp"
#include "lab/verify/ask_oracle.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct EvalOptions {
    CommonOptions common;
    std::vector<std::string> names;  ///< FAMILY KEY, or files
    std::string inputs;
    std::string dialect;
    bool trace = false;
    bool json = false;
};

/// The stage that the input file speaks of, ready to be evaluated.
Result<evaluate::Program> program_of(const Subject& subject, const std::string& stage) {
    ValidateOptions wanted;
    wanted.keep_spirv = true;
    wanted.debug_information = true;
    Validated validated = validate(subject.family, subject.composition, wanted);
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(std::move(validated.diagnostics));
    const Permutation& permutation = subject.composition.permutations.front();
    const int index = stage == "vertex" ? permutation.vertex : permutation.fragment;
    if (index < 0) {
        return fail(Fault::input, fmt::format("there is no {} stage to evaluate", stage),
                    "name its file, or state another 'stage' in the input file");
    }
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

/// What the lighting models say of this point, where the family is ours and reads nothing new.
std::optional<std::vector<verify::Answer>> answers_of(const Subject& subject, const std::string& stage,
                                                      const evaluate::Program& program,
                                                      const evaluate::Invocations& invocation) {
    if (subject.are_files) return std::nullopt;
    return verify::ask_oracle(subject.family, subject.composition.permutations.front().key,
                              stage == "vertex" ? StageKind::vertex : StageKind::fragment, program,
                              invocation);
}

/// {"oracle": [{"output", "exact", "fp32_bound"}]} beside what the report says.
nlohmann::ordered_json with_answers(nlohmann::ordered_json json, const std::vector<verify::Answer>& answers) {
    for (const verify::Answer& answer : answers)
        json["oracle"].push_back(
            {{"output", answer.output}, {"exact", answer.value}, {"fp32_bound", answer.float_error}});
    return json;
}

Outcome run(const EvalOptions& options, const World& world) {
    const Result<Subject> subject = load_subject(world, options.names, options.common, options.dialect);
    if (!subject) return failed(subject.error());
    const Result<std::string> text = read_input(world, options.inputs);
    if (!text) return failed(text.error());
    const Result<evaluate::EvalInputs> inputs = evaluate::read_eval_inputs(*text, options.inputs);
    if (!inputs) return failed(inputs.error());
    const Result<evaluate::Program> program = program_of(*subject, inputs->stage);
    if (!program) return failed(program.error());
    const Result<evaluate::Invocations> invocations = evaluate::invocations_of(*inputs, *program);
    if (!invocations) return failed(invocations.error());
    const Result<evaluate::EvalReport> report =
        evaluate::evaluate_once(*program, *invocations, options.trace);
    if (!report) return failed(report.error());
    const std::vector<verify::Answer> answers =
        answers_of(*subject, inputs->stage, *program, *invocations).value_or(std::vector<verify::Answer>{});
    return {options.json
                ? with_answers(evaluate::to_json(*report), answers).dump(2) + "\n"
                : evaluate::to_text(*report, quote_pieces(subject->composition)) + verify::to_text(answers),
            evaluate::inputs_left_out(*inputs, *program),
            {}};
}

}  // namespace

Command eval_command(CLI::App& gobo) {
    auto options = std::make_shared<EvalOptions>();
    CLI::App* app = gobo.add_subcommand("eval", "Evaluate one invocation of a stage, in fp32 and fp64");
    app->add_option("NAMES", options->names,
                    "FAMILY KEY, or shader files (.vert, .frag, .vert.glsl, .frag.glsl)")
        ->required()
        ->type_name("FAMILY KEY|FILES...");
    app->add_option("--inputs", options->inputs, "The stage, its inputs, uniforms and samplers (TOML)")
        ->required()
        ->type_name("FILE.toml");
    app->add_flag("--trace", options->trace, "Print every operation with its place and values");
    app->add_flag("--json", options->json, "Print JSON");
    add_dialect_option(*app, options->dialect);
    add_common_options(*app, options->common);
    app->footer(
        "An input file:\n"
        "  stage = \"fragment\"\n"
        "  [inputs]\n"
        "  normal = [0, 0, 1]\n"
        "  [uniforms]\n"
        "  \"PointLights.lights[0].position\" = [0, 1, 2, 1]\n"
        "  [samplers]\n"
        "  albedo = [1, 1, 1, 1]   # the colour that every texture function answers\n\n"
        "Examples:\n"
        "  gobo eval lit 'fog=linear point=3' --inputs point.toml\n"
        "  gobo eval game.frag --inputs point.toml --trace");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
