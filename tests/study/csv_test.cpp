// Tables of text, out and in again.
#include "core/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gobo::study {
namespace {

TEST(Csv, ComesBackAsItWas) {
    const CsvTable table{{"key", "renderer"},
                         {{"fog=linear point=3", "llvmpipe (LLVM 15.0.6, 256 bits)"},
                          {"", "said \"fast\""},
                          {"two\nlines", ""}}};
    const std::string text = csv_text(table);
    EXPECT_EQ(
        text,
        "key,renderer\nfog=linear point=3,\"llvmpipe (LLVM 15.0.6, 256 bits)\"\n,\"said \"\"fast\"\"\"\n"
        "\"two\nlines\",\n");
    const CsvTable again = read_csv(text);
    EXPECT_EQ(again.columns, table.columns);
    EXPECT_EQ(again.rows, table.rows);
}

TEST(Csv, TakesOtherPeoplesLines) {
    const CsvTable table = read_csv("a,b,c\r\n1,2\r\n1,2,3,4");
    EXPECT_THAT(table.rows, testing::ElementsAre(testing::ElementsAre("1", "2", ""),
                                                 testing::ElementsAre("1", "2", "3")));
    EXPECT_EQ(table.column("c"), 2u);
    EXPECT_EQ(table.column("d"), std::nullopt);
    EXPECT_EQ(read_csv("\xEF\xBB\xBFgpu,key\n").column("gpu"), 0u);
}

}  // namespace
}  // namespace gobo::study
