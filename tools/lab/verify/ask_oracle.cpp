#include "lab/verify/ask_oracle.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "lab/oracle/model.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/feed.hpp"

namespace gobo::verify {
namespace {

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += fmt::format("{:<25.17g}", number);
    return text.erase(text.find_last_not_of(' ') + 1);
}

}  // namespace

std::optional<std::vector<Answer>> ask_oracle(const Family& family, const Key& key, StageKind stage,
                                              const evaluate::Program& program,
                                              const evaluate::Invocations& invocation) {
    const auto model = oracle::model_of(family, key);
    const std::optional<Sample> sample = sample_of(program, invocation);
    if (!model || !sample) return std::nullopt;
    std::vector<Answer> answers;
    oracle::Decisions decisions;
    for (const Expected& expected : expect(*model, stage, *sample, decisions)) {
        const bool is_there =
            std::any_of(program.outputs.begin(), program.outputs.end(),
                        [&](const evaluate::Port& port) { return port.name == expected.output; });
        if (!is_there) continue;
        answers.push_back(
            {std::string(expected.output),
             {expected.value.begin(), expected.value.begin() + expected.components},
             {expected.float_error.begin(), expected.float_error.begin() + expected.components}});
    }
    return answers;
}

std::string to_text(const std::vector<Answer>& answers) {
    std::string text;
    for (const Answer& answer : answers)
        text += fmt::format("{} as the oracle has it\n  exact       {}\n  fp32 bound  {}\n", answer.output,
                            numbers_text(answer.value), numbers_text(answer.float_error));
    return text;
}

}  // namespace gobo::verify
