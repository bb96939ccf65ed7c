// What is run under callgrind gets its arguments as they are: no shell reads them.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "lab/study/timing.hpp"

namespace gobo::study {
namespace {

TEST(Instructions, AreCountedWithoutAShell) {
    // Only `study --callgrind` needs it, which says so where it is missing.
    if (std::system("valgrind --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "valgrind is not installed";
    const std::string victim = testing::TempDir() + "gobo made by a shell";
    std::filesystem::remove(victim);
    const DrawCommand command = [](const std::string& key, int width, int height) {
        return std::vector<std::string>{"/bin/echo", "fragments", std::to_string(width * height), key};
    };
    const auto counted =
        count_instructions(command, "it's; touch '" + victim + "' $(touch '" + victim + "')");
    ASSERT_TRUE(counted) << to_text(counted.error().front());
    EXPECT_FALSE(std::filesystem::exists(victim));
}

TEST(Instructions, OfWhatCannotBeRunAreAnError) {
    const DrawCommand command = [](const std::string&, int, int) {
        return std::vector<std::string>{"/no/such/program"};
    };
    const auto counted = count_instructions(command, "default");
    ASSERT_FALSE(counted);
    EXPECT_EQ(counted.error().front().fault, Fault::file);
}

}  // namespace
}  // namespace gobo::study
