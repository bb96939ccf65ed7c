// The page on numerics shows what the cases, guards and plain shaders give now.
#include "numerics_page.hpp"

#include <gtest/gtest.h>

#include "common/file_system.hpp"

namespace gobo {
namespace {

constexpr const char* kRemedy = "; `cmake --build --preset release --target numerics` writes it anew";

TEST(NumericsPage, IsWhatTheTestsFind) {
    const DiskFileSystem disk;
    const Result<std::string> csv = disk.read(GOBO_SOURCE_DIR "/docs/data/guard_prices.csv");
    const Result<std::string> page = disk.read(GOBO_SOURCE_DIR "/docs/numerics.md");
    ASSERT_TRUE(csv && page);
    const GuardTimes times = times_of_csv(*csv);
    EXPECT_EQ(numerics_page(times), *page) << "docs/numerics.md is stale" << kRemedy;
    EXPECT_EQ(to_csv(times), *csv) << "docs/data/guard_prices.csv is stale" << kRemedy;
}

/// Times are kept from run to run, but a guard without any is not.
TEST(NumericsPage, HasATimeForEachGuard) {
    const Result<std::string> csv = DiskFileSystem().read(GOBO_SOURCE_DIR "/docs/data/guard_prices.csv");
    ASSERT_TRUE(csv);
    const GuardTimes times = times_of_csv(*csv);
    for (const Guard& guard : lit_guards()) EXPECT_TRUE(times.contains(guard.name)) << guard.name << kRemedy;
}

}  // namespace
}  // namespace gobo
