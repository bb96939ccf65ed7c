#include "lab/commands/finding_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/sanitize/lost_numbers.hpp"

namespace gobo {

Result<Examined> load_examined(const World& world, const FindingOptions& options, const std::string& what) {
    GOBO_TRY(Subject subject,
             load_subject(world, options.names, options.stages, options.dialect, &options, Counts::literal));
    GOBO_TRY_DO(refuse_other_stages(subject.family.family, subject.composition, what));
    GOBO_TRY(Validated validated, compile_over_domains(world, subject, options.inputs));
    append(validated.diagnostics, warn_of_no_keys(subject.composition, "nothing was examined"));
    return Examined{std::move(subject), std::move(validated)};
}

namespace {

bool has_keys(const Subject& subject) {
    return !subject.are_files || !subject.family.family.features.empty();
}

}  // namespace

void leave_out_keys(const Subject& subject, Diagnostics& diagnostics) {
    if (has_keys(subject)) return;
    for (Diagnostic& diagnostic : diagnostics) diagnostic.subject.clear();
}

Diagnostics report_finding(const World& world, const FindingOptions& options, const Subject& subject,
                           const sanitize::Finding& finding, const std::vector<std::size_t>& permutations,
                           std::string message, std::size_t number) {
    Diagnostics diagnostics;
    diagnostics.reserve(finding.consequences.size() + 1);
    Diagnostic& error = diagnostics.emplace_back();
    error.place = finding.place;
    error.quoted_line = quoted_line(subject.composition, finding.place);
    error.message = std::move(message);
    std::vector<std::string> names = options.names;
    std::ranges::transform(names, names.begin(), shell_word);
    std::string what = join(names, " ");
    if (has_keys(subject) && !permutations.empty()) {
        error.subject =
            key_text(subject.family.family, subject.composition.permutations[permutations.front()].key);
        what += fmt::format(" '{}'", error.subject);
    }
    if (!options.dialect.empty()) what += " --dialect " + options.dialect;
    for (const sanitize::Consequence& one : finding.consequences)
        diagnostics.push_back({.severity = Severity::note,
                               .place = one.place,
                               .message = fmt::format("so: {}: {}", one.message, one.operation)});
    if (finding.is_of_constants) {
        error.help =
            "compilers fold it, each to a value of its own: guard the operation, or change a constant";
        return diagnostics;
    }
    const std::string_view cure = finding.message == sanitize::kLostNumber
                                      ? "declare it highp, or scale what it is made of"
                                      : "guard the operation";
    if (options.folder.empty()) {
        error.help = fmt::format(
            "{}; keep an input that shows it with -o DIR, and follow it with gobo eval --trace", cure);
        return diagnostics;
    }
    const std::string name = finding.place.file.substr(finding.place.file.rfind('/') + 1);
    const std::string path =
        fmt::format("{}/{}.{}.{}.toml", options.folder, number, name, finding.place.line);
    const std::string follow = fmt::format("gobo eval {} --inputs {} --trace", what, shell_word(path));
    error.help = fmt::format("{}; follow the input with: {}", cure, follow);
    append(diagnostics, keep_file(world, path, sanitize::eval_input(finding, follow)));
    return diagnostics;
}

Option domains_option(FindingOptions& options) {
    return {"--inputs", "FILE",
            "A file whose [domain] says what inputs and uniforms hold, beside the family's or instead",
            &options.inputs};
}

}  // namespace gobo
