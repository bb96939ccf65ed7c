// What the sanitizer finds: a place, what happens there, and an input that makes it happen.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/sanitize/bounds.hpp"
#include "lab/sanitize/machine.hpp"

namespace gobo::sanitize {

/// The message of a loop that is given up.
inline constexpr std::string_view kEndless = "a loop takes more than 65536 iterations";

/// What one invocation was given.
using Point = evaluate::EvalPoint;

/// What happens because of a finding.
struct Consequence {
    Place place;
    std::string message;
    std::string operation;  ///< with its values

    friend bool operator==(const Consequence&, const Consequence&) = default;
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
    std::vector<Consequence> consequences;  ///< in the order in which they happened
    bool is_of_constants = false;           ///< what compilers fold, whatever the inputs
    bool follows_from_constants = false;    ///< it comes of a constant that is no finite number
};

/// The point as an input file of `gobo eval`, numbers that read back as the same floats. `heading` becomes
/// comment lines.
[[nodiscard]] std::string eval_input(const Finding& finding, const std::string& heading);

/// The finding's message with the operation's values.
[[nodiscard]] std::string to_text(const Finding& finding);

/// Whether the operation, which does not compute floats, makes 16-bit ones of those that it passes on where
/// these are what is mediump: it reads, stores, chooses or converts them.
[[nodiscard]] bool narrows_to_half(const evaluate::Program& program, std::size_t operation);

/// The traps of one stage at the given points; the stage's kind is left to the caller. An output that nothing
/// ever stores to has no place. `bounds` are those of OutputBounds::at(), or empty: points that trap are not
/// held to them. `also` watches, too.
[[nodiscard]] Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                                      const evaluate::Invocations& invocations,
                                                      Machine machine, std::span<const Interval> bounds = {},
                                                      evaluate::Observer<float>* also = nullptr);

}  // namespace gobo::sanitize
