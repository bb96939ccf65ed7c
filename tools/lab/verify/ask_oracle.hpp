// The oracle's answer for one invocation, whatever it was given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "family/family.hpp"

namespace gobo::verify {

/// What one output ought to be.
struct Answer {
    std::string output;
    std::vector<double> value;
    std::vector<double> float_error;  ///< bound of a float evaluation's error
};

/// The answers for the outputs that the stage has; nothing where the oracle does not know the key's model or
/// an input of the stage. Inputs that are not given are 0.
[[nodiscard]] std::optional<std::vector<Answer>> ask_oracle(const Family& family, const Key& key,
                                                            StageKind stage, const evaluate::Program& program,
                                                            const evaluate::Invocations& invocation);

/// One line for each answer and one for its bound.
[[nodiscard]] std::string to_text(const std::vector<Answer>& answers);

}  // namespace gobo::verify
