// What the sanitizer finds: a place, what happens there, and an input that makes it happen.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/diagnostic.hpp"
#include "compose/composition.hpp"
#include "evaluate/evaluate.hpp"
#include "sanitize/machine.hpp"

namespace gobo::sanitize {

/// What one invocation was given, by reflected name, component by component.
struct Point {
    std::map<std::string, std::vector<double>> inputs;
    std::map<std::string, std::vector<double>> uniforms;
    std::map<std::string, std::vector<double>> samplers;  ///< the colour that each texture answers
};

/// An undefined operation at one place of one stage.
struct Finding {
    StageKind stage = StageKind::vertex;
    Place place;
    std::string message;    ///< "division by zero"
    std::string operation;  ///< with its values: "FDiv 1, depth = 0 -> inf"; empty where there is none
    Machine machine = Machine::ieee;  ///< that the example was run on
    Point point;                      ///< the first that showed it
    std::uint64_t points = 0;
};

/// Invocation `index` of a stage's inputs.
[[nodiscard]] Point point_of(const evaluate::Program& program, const evaluate::Invocations& invocations,
                             std::size_t index);

/// The point as an input file of `gobo eval`: `stage`, `[inputs]`, `[uniforms]` and `[samplers]` by
/// reflected name, numbers that read back as the same floats. `heading` becomes comment lines.
[[nodiscard]] std::string eval_input(const Finding& finding, const std::string& heading);

/// The finding's message with the operation's values.
[[nodiscard]] std::string to_text(const Finding& finding);

}  // namespace gobo::sanitize
