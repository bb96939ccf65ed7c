// gobo show: the composed source of one key.
#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct ShowOptions {
    std::string family;
    std::string key;
    std::string stage;
    std::string dialect;
    bool pieces = false;
    bool comments = false;
};

std::string shown(const Composition& composition, int index, bool names_pieces) {
    const Stage& stage = composition.stages[index];
    if (!names_pieces) return source_of(composition, stage);
    std::string text;
    for (const int piece : stage.pieces) text += composition.pieces[piece].name + "\n";
    return text;
}

Result<Outcome> run(const ShowOptions& options, const World& world) {
    GOBO_TRY(LoadedFamily family, load_family(world, options.family, options.dialect));
    if (options.comments) family.comments = Comments::keep;
    GOBO_TRY(Composition composition, compose_selection(world, family, {.keys = {options.key}}));
    // Of SPIR-V it shows when the stages are compiled whether counts stay numbers. What is wrong is told beside
    // the source, which is what one looks at then.
    Diagnostics problems;
    if (is_spirv(family.dialect))
        if (auto validated = compile(world, family, composition, {}); !validated)
            problems = std::move(validated).error();
    const Permutation& permutation = composition.permutations.front();
    const std::optional<StageKind> only = stage_named(options.stage);
    if (only && permutation.stages[*only] < 0)
        return fail(Fault::usage, fmt::format("the key '{}' has no {} stage",
                                              key_text(family.family, permutation.key), name_of(*only)));
    std::vector<std::string> texts;
    for (const StageNames& stage : kStages) {
        const int number = permutation.stages[stage.kind];
        if (number < 0 || only.value_or(stage.kind) != stage.kind) continue;
        const std::string text = shown(composition, number, options.pieces);
        texts.push_back(only ? text
                             : fmt::format("{}{}:\n{}", options.pieces ? "" : "// ", stage.name, text));
    }
    append(problems, composition.notes);
    return Outcome{join(texts, "\n"), std::move(problems)};
}

}  // namespace

Command show_command() {
    const auto options = std::make_shared<ShowOptions>();
    return {{"show", "The composed source of a key"},
            {family_argument(options->family),
             {"KEY", "", "A key, such as 'fog=linear point=3', or default", &options->key, kRequired},
             {"--stage", stage_words(), "Only this stage", &options->stage, kOneOf},
             {"--pieces", "", "Print the pieces' names instead of their text", &options->pieces},
             comments_option(options->comments),
             dialect_option(options->dialect)},
            {},
            "  gobo show lit default\n"
            "  gobo show lit 'fog=linear point=3' --stage fragment | glslangValidator --stdin -S frag -G\n"
            "  gobo show lit 'fog=linear point=3' --pieces\n"
            "  gobo show lit 'spot=1' --stage vertex --dialect es300",
            [options](const World& world) { return run(*options, world); },
            "Without --stage all stages are printed for a reader, each behind its name. What another program "
            "is to take is printed with --stage: that source alone, as it is shipped. Of dialects of SPIR-V the "
            "key is checked too: its errors come with the source."};
}

}  // namespace gobo
