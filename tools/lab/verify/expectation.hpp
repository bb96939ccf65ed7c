// The oracle asked: what it expects of a stage's outputs at a sample, and how near is near enough.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/oracle/lights.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// One output.
struct Expected {
    std::string output;  ///< reflected name
    std::uint32_t components = 0;
    std::array<double, 4> value{};
    std::array<double, 4> largest{};      ///< sum of the absolute terms: doubles are judged by it
    std::array<double, 4> float_error{};  ///< bound of a float evaluation's error
    bool is_flat = false;  ///< of a vertex stage: the provoking vertex's value holds for the whole triangle
    std::array<double, 4> whole{};  ///< of a colour: what approximations err by a part of
};

/// A double evaluation may be this far off, relative to the largest term: some hundred double roundings
/// (1e-14) by the worst condition of ordinary inputs (1e3 for a shininess, 1e2 for a near light), and what
/// the library's series leave out on purpose.
inline constexpr double kDoubleTolerance = 1e-9;

/// The name under which a fragment stage is expected to discard (1) or not (0): no output's.
inline constexpr std::string_view kDiscard = "discard";

/// The outputs that the stage may have, and kDiscard, alone where the fragment is discarded; those it does
/// not have are of no concern.
[[nodiscard]] std::vector<Expected> expect(const oracle::Model& model, StageKind stage, const Sample& sample,
                                           oracle::Decisions& decisions);

/// What one output ought to be.
struct Answer {
    std::string output;
    std::vector<double> value;
    std::vector<double> float_error;  ///< bound of a float evaluation's error, its inputs' rounding with it
};

/// The answers for the outputs that the stage has; nothing where the oracle does not know the key's model or
/// an input of the stage. Inputs that are not given are 0.
[[nodiscard]] std::optional<std::vector<Answer>> ask_oracle(const Family& family, const Key& key,
                                                            StageKind stage, const evaluate::Program& program,
                                                            const evaluate::Invocations& invocation);

/// One line for each answer and one for its bound.
[[nodiscard]] std::string to_text(const std::vector<Answer>& answers);

}  // namespace gobo::verify
