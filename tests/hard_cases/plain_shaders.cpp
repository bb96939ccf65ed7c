#include "plain_shaders.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/file_system.hpp"
#include "common/text.hpp"
#include "compose/compose.hpp"
#include "compose/loose_files.hpp"
#include "validate/validate.hpp"

namespace gobo {

Lines marked_lines(const std::string& source) {
    constexpr std::string_view kMark = "// trap: ";
    Lines lines;
    const auto count = std::count(source.begin(), source.end(), '\n');
    for (int number = 1; number <= count; ++number) {
        const std::string_view line = line_of(source, number);
        const auto mark = line.find(kMark);
        if (mark != std::string_view::npos)
            lines.insert(fmt::format("{}: {}", number, line.substr(mark + kMark.size())));
    }
    return lines;
}

sanitize::SanitizeReport report_of(const std::string& path) {
    const DiskFileSystem disk;
    SearchPath search;
    const Result<Family> family = family_of_files({path}, disk, search);
    EXPECT_TRUE(family) << path;
    const Result<Composition> composition = compose(*family, {Key{}}, search, Dialect::own);
    EXPECT_TRUE(composition) << path;
    ValidateOptions options;
    options.keep_spirv = true;
    options.debug_information = true;
    const Validated validated = validate(*family, *composition, options);
    EXPECT_EQ(exit_status(validated.diagnostics), 0) << path;
    return sanitize::sanitize(*family, *composition, validated, {});
}

std::vector<std::string> shaders_in(const std::string& folder) {
    std::vector<std::string> paths;
    const std::string whole = std::string(GOBO_SOURCE_DIR "/tests/hard_cases/") + folder;
    for (const auto& entry : std::filesystem::directory_iterator(whole))
        paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

Lines found_lines(const sanitize::SanitizeReport& report) {
    Lines lines;
    for (const sanitize::SharedFinding& shared : report.findings)
        lines.insert(fmt::format("{}: {}", shared.finding.place.line, shared.finding.message));
    return lines;
}

}  // namespace gobo
