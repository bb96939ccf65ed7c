// Finished measurements outlive whoever took them.
#include "study/journal.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gobo::study {
namespace {

/// As append_to_disk(), in memory.
Append append_to(MemoryFileSystem& files) {
    return [&files](const std::string& path, std::string_view text) -> Result<void> {
        const std::string before = files.is_file(path) ? files.read(path).value() : "";
        if (auto written = files.write(path, before + std::string(text)); !written)
            return tl::unexpected(written.error());
        return {};
    };
}

const std::string kPath = "study/measurements.jsonl";

TEST(Journal, KeepsWhatWasAdded) {
    MemoryFileSystem files;
    Journal first(files, kPath, append_to(files));
    ASSERT_TRUE(first.add("a", {1, 2}));
    ASSERT_TRUE(first.add("b", {{"error", 0.5}}));
    const Journal second(files, kPath, append_to(files));
    EXPECT_EQ(second.find("a"), nlohmann::json({1, 2}));
    EXPECT_EQ(second.find("b"), nlohmann::json({{"error", 0.5}}));
    EXPECT_EQ(second.find("c"), std::nullopt);
}

TEST(Journal, LosesOnlyALineThatWasCutOff) {
    MemoryFileSystem files;
    ASSERT_TRUE(files.write(kPath, "{\"identity\":\"a\",\"measured\":1}\n{\"identity\":\"b\",\"meas"));
    Journal journal(files, kPath, append_to(files));
    EXPECT_EQ(journal.find("a"), nlohmann::json(1));
    EXPECT_EQ(journal.find("b"), std::nullopt);
    ASSERT_TRUE(journal.add("c", 3));
    const Journal again(files, kPath, append_to(files));
    EXPECT_EQ(again.find("a"), nlohmann::json(1));
    EXPECT_EQ(again.find("c"), nlohmann::json(3));
}

TEST(Journal, WithoutAFileStillRemembers) {
    Journal journal;
    ASSERT_TRUE(journal.add("a", 1));
    EXPECT_EQ(journal.find("a"), nlohmann::json(1));
}

}  // namespace
}  // namespace gobo::study
