// Finished measurements outlive whoever took them.
#include "lab/study/journal.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "study_support.hpp"

namespace gobo::study {
namespace {

const std::string kPath = "study/measurements.jsonl";

TEST(Journal, KeepsWhatWasAdded) {
    MemoryFileSystem files;
    Journal first(files, kPath, append_to(files));
    ASSERT_TRUE(first.add<nlohmann::json>("a", {1, 2}));
    ASSERT_TRUE(first.add<nlohmann::json>("b", {{"error", 0.5}}));
    const Journal second(files, kPath, append_to(files));
    ASSERT_TRUE(second.find<nlohmann::json>("a"));
    EXPECT_EQ(second.find<nlohmann::json>("a")->dump(), "[1,2]");
    ASSERT_TRUE(second.find<nlohmann::json>("b"));
    EXPECT_EQ(second.find<nlohmann::json>("b")->dump(), R"({"error":0.5})");
    EXPECT_FALSE(second.find<nlohmann::json>("c"));
}

TEST(Journal, LosesOnlyALineThatWasCutOff) {
    MemoryFileSystem files;
    ASSERT_TRUE(files.write(kPath, "{\"identity\":\"a\",\"measured\":1}\n{\"identity\":\"b\",\"meas"));
    Journal journal(files, kPath, append_to(files));
    EXPECT_TRUE(journal.find<nlohmann::json>("a"));
    EXPECT_FALSE(journal.find<nlohmann::json>("b"));
    ASSERT_TRUE(journal.add<nlohmann::json>("c", 3));
    const Journal again(files, kPath, append_to(files));
    EXPECT_TRUE(again.find<nlohmann::json>("a"));
    EXPECT_TRUE(again.find<nlohmann::json>("c"));
}

TEST(Journal, WithoutAFileStillRemembers) {
    Journal journal;
    ASSERT_TRUE(journal.add<nlohmann::json>("a", 1));
    EXPECT_TRUE(journal.find<nlohmann::json>("a"));
}

}  // namespace
}  // namespace gobo::study
