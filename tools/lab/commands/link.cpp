// gobo link: whether OpenGL's own compiler takes what gobo takes, key by key.
#include <map>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/commands/lab_input.hpp"
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

/// The composition with one key of it at a time.
class Judge {
  public:
    Judge(const World& world, const LoadedFamily& family, const Composition& composition, Context context)
        : family_(family.family), one_(composition), context_(std::move(context)) {
        options_.child_processes = !world.options.in_process;
    }

    const Verdict& verdict(const Permutation& permutation) {
        const auto [known, is_new] = verdicts_.try_emplace(permutation.stages);
        if (!is_new) return known->second;
        one_.permutations = {permutation};
        known->second.refused_by_gobo = first_error(validate(family_, one_, options_).diagnostics);
        if (const auto program = link_program(context_, stages_of(one_, permutation)); !program)
            known->second.refused_by_driver = first_error(program.error());
        known->second.is_too_new =
            known->second.refused_by_driver.find("is not supported. Supported versions") != std::string::npos;
        return known->second;
    }

  private:
    const Family& family_;
    Composition one_;
    Context context_;
    ValidateOptions options_;
    std::map<StageNumbers, Verdict> verdicts_;
};

Result<Outcome> run(const LinkOptions& options, const World& world) {
    GOBO_TRY(const Backend backend, backend_of(options.backend));
    GOBO_TRY(const Subject subject,
             load_subject(world, options.names, options.stages, options.dialect, &options));
    GOBO_TRY(const Context context, open_context(backend));
    const std::string renderer = context.renderer();
    Judge judge(world, subject.family, subject.composition, context);
    std::string text;
    Diagnostics diagnostics;
    int both = 0;
    int neither = 0;
    int laxer = 0;
    int stricter = 0;
    for (const Permutation& permutation : subject.composition.permutations) {
        const Verdict& verdict = judge.verdict(permutation);
        const std::string key =
            subject.are_files ? "the files" : key_text(subject.family.family, permutation.key);
        const bool is_taken = verdict.refused_by_gobo.empty();
        if (verdict.is_too_new) {
            diagnostics.push_back(
                {.severity = Severity::warning,
                 .message = "not compared: the driver lacks this version of GLSL",
                 .help = "ask another driver by --backend, or write it for another --dialect",
                 .subject = key});
        } else if (is_taken == verdict.refused_by_driver.empty()) {
            ++(is_taken ? both : neither);
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
    text += fmt::format(
        "{} compared: {} taken and linked, {} refused by both, {} taken that the driver refuses, {} refused "
        "that "
        "it links\n",
        both + neither + laxer + stricter, both, neither, laxer, stricter);
    return Outcome{std::move(text), std::move(diagnostics), fmt::format("by {}", renderer)};
}

}  // namespace

Command link_command() {
    const auto options = std::make_shared<LinkOptions>();
    return {titles::kLink,
            {subject_argument(options->names),
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
            "stricter than this driver."};
}

}  // namespace gobo
