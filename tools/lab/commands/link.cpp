// gobo link: whether OpenGL's own compiler takes what gobo takes, key by key.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/render/driver_tasks.hpp"
#include "lab/render/program.hpp"

namespace gobo {
namespace {

struct LinkOptions : SelectionOptions {
    std::vector<std::string> names;
    std::vector<std::string> stages;
    std::string backend = "osmesa";
};

/// What one program comes to.
struct Verdict {
    std::string refused_by_gobo;  ///< the first error; empty where it is taken
    std::string refused_by_driver;
    bool is_too_new = false;  ///< the driver lacks the version of GLSL
};

std::string first_error(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics)
        if (diagnostic.severity == Severity::error) {
            Diagnostic bare = diagnostic;
            bare.subject.clear();
            bare.help.clear();
            bare.quoted_line.clear();
            const std::string text = to_text(bare);
            return text.substr(0, text.find('\n'));
        }
    return {};
}

/// What a child process found out about one program.
struct Answer {
    std::string renderer;
    std::string refused;  ///< why the driver does not link it; empty where it does
};

GOBO_FIELDS(Answer, renderer, refused)

/// The composition of one key.
Composition only(const Composition& all, const Permutation& permutation) {
    Composition one = all;
    one.permutations = {permutation};
    return one;
}

/// Asks the driver of each program: one that crashes it or never ends is a verdict, too.
Result<std::string> ask(Backend backend, const Composition& composition,
                        const std::vector<const Permutation*>& programs, int jobs,
                        std::vector<Verdict>& verdicts) {
    std::string renderer;
    DriverTasks<Context, Answer> tasks{"the driver", programs.size(), jobs};
    tasks.open = [&] { return open_context(backend); };
    tasks.work = [&](const Context& context, std::size_t task, DriverClock&) -> Result<Answer> {
        const auto program = link_program(context, stages_of(composition, *programs[task]));
        return Answer{context.renderer(), program ? "" : first_error(program.error())};
    };
    tasks.done = [&](std::size_t task, Result<Answer> answer, std::optional<int>) {
        verdicts[task].refused_by_driver = answer ? answer->refused : first_error(answer.error());
        if (answer) renderer = answer->renderer;
    };
    GOBO_TRY_DO(ask_driver(tasks));
    return renderer;
}

Result<Outcome> run(const LinkOptions& options, const World& world) {
    GOBO_TRY(const Backend backend, backend_of(options.backend));
    GOBO_TRY(const Subject subject,
             load_subject(world, options.names, options.stages, options.dialect, &options));
    if (is_spirv(subject.composition.dialect))
        return fail(Fault::usage,
                    fmt::format("gobo link asks OpenGL's compiler of texts, and --dialect {} ships SPIR-V",
                                name_of(subject.composition.dialect)),
                    "leave --dialect out, or check it by gobo check");
    std::map<StageNumbers, std::size_t> numbers;
    std::vector<const Permutation*> programs;
    for (const Permutation& permutation : subject.composition.permutations)
        if (numbers.try_emplace(permutation.stages, programs.size()).second) programs.push_back(&permutation);
    std::vector<Verdict> verdicts(programs.size());
    GOBO_TRY(const std::string renderer,
             ask(backend, subject.composition, programs, std::max(world.options.jobs, 1), verdicts));
    ValidateOptions validate_options;
    validate_options.child_processes = !world.options.in_process;
    for (std::size_t i = 0; i < programs.size(); ++i) {
        verdicts[i].refused_by_gobo = first_error(
            validate(subject.family.family, only(subject.composition, *programs[i]), validate_options)
                .diagnostics);
        verdicts[i].is_too_new =
            verdicts[i].refused_by_driver.find("is not supported. Supported versions") != std::string::npos ||
            verdicts[i].refused_by_driver.find("the compatibility profile is not supported") !=
                std::string::npos;
    }
    std::string text;
    Diagnostics diagnostics;
    int both = 0;
    int neither = 0;
    int laxer = 0;
    int stricter = 0;
    for (const Permutation& permutation : subject.composition.permutations) {
        const Verdict& verdict = verdicts[numbers.at(permutation.stages)];
        const std::string key =
            subject.are_files ? "the files" : key_text(subject.family.family, permutation.key);
        const bool is_taken = verdict.refused_by_gobo.empty();
        if (verdict.is_too_new) {
            diagnostics.push_back(
                {.severity = Severity::warning,
                 .message = "not compared: the driver lacks this version or profile of GLSL",
                 .help = "ask another driver by --backend, or write it for another --dialect",
                 .subject = key});
        } else if (is_taken == verdict.refused_by_driver.empty()) {
            ++(is_taken ? both : neither);
            if (!is_taken) text += fmt::format("{}: refused by both: {}\n", key, verdict.refused_by_gobo);
        } else if (is_taken) {
            ++laxer;
            diagnostics.push_back({.message = fmt::format("gobo takes what the driver does not link: {}",
                                                          verdict.refused_by_driver),
                                   .help = "please report it, with what 'gobo show' prints",
                                   .subject = key});
        } else {
            ++stricter;
            text +=
                fmt::format("{}: refused, though the driver links it: {}\n", key, verdict.refused_by_gobo);
        }
    }
    append(diagnostics, warn_of_no_keys(subject.composition, "nothing was compared"));
    text += fmt::format(
        "{} compared: {} taken and linked, {} refused by both, {} taken that the driver refuses, {} refused "
        "that "
        "it links\n",
        both + neither + laxer + stricter, both, neither, laxer, stricter);
    return Outcome{std::move(text), std::move(diagnostics),
                   renderer.empty() ? "" : fmt::format("by {}", renderer)};
}

}  // namespace

Command link_command() {
    const auto options = std::make_shared<LinkOptions>();
    return {titles::kLink,
            {family_or_files_argument(options->names),
             stages_option(options->stages),
             {"--backend", "osmesa|egl", "Whose driver is asked", &options->backend},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo link lit --cover 2\n"
            "  gobo link game.toml --all --backend egl\n"
            "  gobo link game.vert game.frag",
            [options](const World& world) { return run(*options, world); },
            "Compiles and links each key by OpenGL's own driver, and compares its verdict with gobo's. A key "
            "that gobo takes and the driver does not link is an error; one that gobo refuses and the driver "
            "links is listed with gobo's reason: GLSL's specification or a limit that OpenGL guarantees is "
            "stricter than this driver. So is what both refuse."};
}

}  // namespace gobo
