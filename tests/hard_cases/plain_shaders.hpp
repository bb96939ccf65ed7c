// Textbook shaders, each with marks at the lines that the sanitizer must flag ("// trap: message").
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sanitize/sanitize.hpp"

namespace gobo {

/// "7: division by zero".
using Lines = std::set<std::string>;

/// The lines that the source marks.
[[nodiscard]] Lines marked_lines(const std::string& source);
/// The paths of the files in tests/hard_cases/FOLDER, sorted.
[[nodiscard]] std::vector<std::string> shaders_in(const std::string& folder);
/// What the sanitizer finds in a file; failing to run it fails the test.
[[nodiscard]] sanitize::SanitizeReport report_of(const std::string& path);
/// The lines that a report names.
[[nodiscard]] Lines found_lines(const sanitize::SanitizeReport& report);

}  // namespace gobo
