#include "lab/sanitize/finding.hpp"

#include <fmt/format.h>

namespace gobo::sanitize {
std::string to_text(const Finding& finding) {
    std::string text = finding.message;
    if (!finding.operation.empty()) text += ": " + finding.operation;
    if (finding.machine != Machine::ieee) text += fmt::format(", machine {}", name_of(finding.machine));
    return text;
}

std::string eval_input(const Finding& finding, const std::string& heading) {
    const std::string comment =
        fmt::format("# {}\n# {}:{}: {}\n", heading, finding.place.file, finding.place.line, to_text(finding));
    return evaluate::eval_file(gobo::name_of(finding.stage), finding.point, comment,
                               evaluate::Digits::of_float);
}

}  // namespace gobo::sanitize
