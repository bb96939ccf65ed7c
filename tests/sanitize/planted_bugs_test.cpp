// Traps behind narrow conditions: found by a search that learns from what it reached, and not by one of as
// many points that does not.
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "sanitize_support.hpp"

namespace gobo {
namespace {

class PlantedBug : public testing::TestWithParam<std::string> {};

constexpr std::size_t kPoints = 400 * 1024;

TEST_P(PlantedBug, IsFoundByTheGuidedSearch) {
    sanitize::SanitizeOptions options;
    options.points = 1024;
    options.guided = kPoints;
    options.machines = {sanitize::Machine::ieee};
    const sanitize::SanitizeReport report = sanitized_file(GetParam(), options);
    EXPECT_EQ(found_lines(report), marked_lines(GetParam()));
    EXPECT_EQ(not_replayed(GetParam(), *DiskFileSystem().read(GetParam()), report), Lines{});
}

TEST_P(PlantedBug, IsMissedByASearchThatDoesNotLearn) {
    sanitize::SanitizeOptions options;
    options.points = kPoints + 1024;
    options.machines = {sanitize::Machine::ieee};
    EXPECT_EQ(found_lines(sanitized_file(GetParam(), options)), Lines{});
}

INSTANTIATE_TEST_SUITE_P(Files, PlantedBug, testing::ValuesIn(shader_files("sanitize/planted")),
                         file_test_name);

}  // namespace
}  // namespace gobo
