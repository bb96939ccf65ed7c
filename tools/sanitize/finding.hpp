// What the sanitizer finds: a place, what happens there, and an input that makes it happen.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/diagnostic.hpp"
#include "compose/composition.hpp"
#include "evaluate/evaluate.hpp"

namespace gobo::sanitize {

/// What one invocation was given, by reflected name, component by component.
struct Point {
    std::map<std::string, std::vector<double>> inputs;
    std::map<std::string, std::vector<double>> uniforms;
};

/// An undefined operation at one place of one stage.
struct Finding {
    StageKind stage = StageKind::vertex;
    Place place;
    std::string message;      ///< "division by zero"
    std::string operation;    ///< with its values: "FDiv 1, depth = 0 -> inf"; empty where there is none
    bool is_flushed = false;  ///< the example needs denormal numbers taken as 0
    Point point;              ///< the first that showed it
    std::uint64_t points = 0;
};

/// Invocation `index` of a stage's inputs. Values that hold for all invocations are found too.
[[nodiscard]] Point point_of(const evaluate::Program& program, const evaluate::Invocations& invocations,
                             std::size_t index);

/// One point as invocations of the stage: a single one.
[[nodiscard]] evaluate::Invocations invocations_of(const Point& point);

/// The point as an input file of `gobo eval`: `stage`, `[inputs]` and `[uniforms]` by reflected name, numbers
/// that read back as they were. `heading` becomes comment lines.
[[nodiscard]] std::string eval_input(const Finding& finding, const std::string& heading);

/// The finding's message with the operation's values.
[[nodiscard]] std::string to_text(const Finding& finding);

}  // namespace gobo::sanitize
