// Shader files that say in comments what is to be found in them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lab/sanitize/sanitize.hpp"

namespace gobo {

/// "7: division by zero".
using Lines = std::set<std::string>;

/// Of the lines that end in "// trap: message"; several messages of one line stand apart by "; ".
[[nodiscard]] Lines marked_lines(const std::string& path);
/// Of the report's findings.
[[nodiscard]] Lines found_lines(const sanitize::SanitizeReport& report);

/// Of what follows from them.
[[nodiscard]] Lines consequences(const sanitize::SanitizeReport& report);

/// What tests are called whose rows have names.
inline constexpr auto row_name = [](const auto& info) { return info.param.name; };

/// The files of a folder of tests/, sorted; failing to read it fails the test.
[[nodiscard]] std::vector<std::string> shader_files(const std::string& folder);
/// "linear_fog_frag".
[[nodiscard]] std::string file_test_name(const testing::TestParamInfo<std::string>& info);

/// What sanitizing the file gives; failing any step fails the test.
[[nodiscard]] sanitize::SanitizeReport sanitized_file(const std::string& path,
                                                      const sanitize::SanitizeOptions& options);
/// The same for a shader's text; `name` tells its stage: "planted.frag".
[[nodiscard]] sanitize::SanitizeReport sanitized_text(const std::string& name, const std::string& text,
                                                      const sanitize::SanitizeOptions& options,
                                                      const std::vector<Domain>& domains = {});
/// The findings whose input, written as a file and read back, does not show the same operation with the same
/// values at the same place. The shader is that of sanitized_text().
[[nodiscard]] Lines not_replayed(const std::string& name, const std::string& text,
                                 const sanitize::SanitizeReport& report);
/// The range of that name.
[[nodiscard]] Domain domain(const std::string& name, double low, double high);

/// The stage of that text, or of a file, decoded.
[[nodiscard]] evaluate::Program program_of(const std::string& name, const std::string& text);
[[nodiscard]] evaluate::Program program_of_file(const std::string& path);

}  // namespace gobo
