// The guards of the shader library: each line of a piece that a comment marks `// guard: ...`.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "lit_cases.hpp"

namespace gobo {

/// A guard, and the plain formula that stands there without it.
struct Guard {
    std::string name;
    std::string piece;      ///< by include path: "fog/linear.glsl"
    std::string guarded;    ///< the text as the piece has it, on the marked line
    std::string plain;      ///< what the textbook has in its place
    std::string needed_by;  ///< the name of a case that fails without it
};

/// For messages of tests.
inline void PrintTo(const Guard& guard, std::ostream* out) {
    *out << guard.name;
}

[[nodiscard]] const std::vector<Guard>& lit_guards();

/// A line of a piece that is marked as a guard.
struct GuardMark {
    std::string piece;
    int line = 0;
    std::string text;
    std::string line_before;  ///< where a guard may be made ready
};

/// All marked lines of code below shader_lib, by piece and line.
[[nodiscard]] std::vector<GuardMark> guard_marks();

/// The piece's text with the plain formula in the guard's place; fails the test where the piece has no such
/// text.
[[nodiscard]] std::string without_guard(const Guard& guard);

/// The case of that name; nullptr where there is none.
[[nodiscard]] const Case* case_named(const std::string& name);

}  // namespace gobo
