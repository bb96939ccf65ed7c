// The page on numerics shows what the cases, guards and plain shaders give now.
#include "numerics_page.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "hard_case_index.hpp"
#include "normal_errors.hpp"
#include "pbr_guards.hpp"
#include "plain_shaders.hpp"

namespace gobo {
namespace {

constexpr const char* kHelp = "; `cmake --build --preset release --target numerics` writes it anew";

TEST(NumericsPage, IsWhatTheTestsFind) {
    const DiskFileSystem disk;
    const Result<std::string> csv = disk.read(GOBO_SOURCE_DIR "/docs/data/guard_prices.csv");
    const Result<std::string> page = disk.read(GOBO_SOURCE_DIR "/docs/numerics.md");
    ASSERT_TRUE(csv && page);
    const GuardTimes times = times_of_csv(*csv);
    EXPECT_EQ(numerics_page(times), *page) << "docs/numerics.md is stale" << kHelp;
    EXPECT_EQ(to_csv(times), *csv) << "docs/data/guard_prices.csv is stale" << kHelp;
}

/// Times are kept from run to run, but a guard without any is not.
TEST(NumericsPage, HasATimeForEachGuard) {
    const Result<std::string> csv = DiskFileSystem().read(GOBO_SOURCE_DIR "/docs/data/guard_prices.csv");
    ASSERT_TRUE(csv);
    const GuardTimes times = times_of_csv(*csv);
    for (const Guard& guard : all_guards()) EXPECT_TRUE(times.contains(guard.name)) << guard.name << kHelp;
}

bool has_case(const HardCase& hard) {
    return std::any_of(lit_cases().begin(), lit_cases().end(),
                       [&](const Case& tested) { return is_about(tested, hard); });
}

bool has_plain_shader(const HardCase& hard) {
    const std::vector<std::string> paths = shader_files("hard_cases/plain");
    return std::any_of(paths.begin(), paths.end(),
                       [&](const std::string& path) { return shows(*DiskFileSystem().read(path), hard); });
}

TEST(HardCases, AreEachTriedAndHaveAPlainShader) {
    for (const HardCase& hard : hard_cases()) {
        EXPECT_TRUE(has_plain_shader(hard)) << "no file of tests/hard_cases/plain/ shows: " << hard.name;
        EXPECT_TRUE(has_case(hard) || !hard.elsewhere.empty()) << "nothing tries: " << hard.name;
        for (const std::string& path : hard.elsewhere) {
            const Result<std::string> text = DiskFileSystem().read(GOBO_SOURCE_DIR "/tests/" + path);
            ASSERT_TRUE(text) << path;
            EXPECT_NE(text->find(hard.name), std::string::npos) << path << " does not name: " << hard.name;
        }
    }
}

TEST(HardCases, AreAllInTheCatalogueOrAModelsOwn) {
    const Result<std::string> models = DiskFileSystem().read(GOBO_SOURCE_DIR "/docs/models.toml");
    ASSERT_TRUE(models);
    for (const Case& tested : lit_cases()) {
        EXPECT_FALSE(tested.about.empty()) << tested.name;
        for (const std::string& about : tested.about)
            EXPECT_TRUE(models->find('"' + about + '"') != std::string::npos ||
                        std::any_of(hard_cases().begin(), hard_cases().end(),
                                    [&](const HardCase& hard) { return hard.name == about; }))
                << tested.name << ": " << about;
    }
}

/// What the page says of the extreme scale in words.
TEST(NormalErrors, AreThreeHundredthsOfARadianNearTheLongAxis) {
    for (const NormalErrors& errors : normal_errors()) {
        EXPECT_TRUE(errors.away < 0.1 || errors.plain <= 2e-3) << errors.away << ": " << errors.plain;
        EXPECT_TRUE(errors.away > 0.003 || errors.plain >= 0.03) << errors.away << ": " << errors.plain;
        EXPECT_TRUE(errors.away < 0.01 || errors.ours <= 1e-5) << errors.away << ": " << errors.ours;
    }
}

}  // namespace
}  // namespace gobo
