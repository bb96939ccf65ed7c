// Textbook shaders, with marks at the lines that go wrong: "// trap: message" where the sanitizer must say
// so, and "// wrong at INPUTS: 1, not 0.75" or "// inexact at INPUTS: 1, not 0.75" where nothing undefined
// happens, but the first number comes out instead of the second.
#pragma once

#include <string>
#include <vector>

#include "../sanitize/sanitize_support.hpp"
#include "hard_case_index.hpp"
#include "lit_under_test.hpp"

namespace gobo {

/// Of the lines that end in "// so: message": what follows from those.
[[nodiscard]] Lines following_lines(const std::string& source);

/// A line that gives another result than it should.
struct WrongMark {
    int line = 0;
    bool is_inexact = false;  ///< only rounded: double precision is right. Otherwise it is as wrong
    std::string at;           ///< "cosine = 1; levels = 4"
    Inputs inputs;            ///< the same
    std::string plain;        ///< what comes out, as number_text() writes it
    std::string right;        ///< what should
};
/// Of the source, at most one a line; a mark that cannot be read fails the test.
[[nodiscard]] std::vector<WrongMark> wrong_marks(const std::string& source);

/// "0.75", "nan": six digits.
[[nodiscard]] std::string number_text(double number);

/// The first output's first component of the stage in that file, in fp32 or double; failing to run it fails
/// the test.
[[nodiscard]] double result_of(const std::string& path, const Inputs& inputs, bool is_double);

/// The comment on a plain shader's second line: "tiny cone: a cone of 1e-4 radians ...", the hard cases that
/// it shows first.
[[nodiscard]] std::string subject_of(const std::string& source);
/// Whether the subject names the hard case.
[[nodiscard]] bool shows(const std::string& source, const HardCase& hard);

}  // namespace gobo
