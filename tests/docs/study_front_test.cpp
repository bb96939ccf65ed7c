// The front that docs/study.md shows is that of the study which is shipped.
#include <regex>

#include <gtest/gtest.h>

#include "page.hpp"
#include "reader.hpp"

namespace gobo {
namespace {

/// The commands that the page prints beside its tables, and the picture of each.
struct Shown {
    const char* name;
    const char* command;  ///< as a regular expression
    const char* picture;
};

class StudyFronts : public testing::TestWithParam<Shown> {
  protected:
    StudyFronts() : page_(text_of_file(GOBO_SOURCE_DIR "/docs/study.md")) {
        std::smatch found;
        if (std::regex_search(page_, found, std::regex(GetParam().command))) command_ = found[1].str();
    }

    std::string page_;
    std::string command_;
};

TEST_P(StudyFronts, AreWhatTheirCommandPrints) {
    ASSERT_NE(command_, "") << "the page prints no such command";
    Reader reader(GOBO_COMMAND);
    const CommandResult table = reader.run(command_);
    ASSERT_EQ(table.status, 0) << table.printed;
    EXPECT_NE(page_.find(table.printed), std::string::npos) << "put this into the page:\n" << table.printed;
}

TEST_P(StudyFronts, AreDrawnAsTheirCommandDrawsThem) {
    ASSERT_NE(command_, "");
    Reader reader(GOBO_COMMAND);
    const CommandResult drawn = reader.run(command_ + " --svg study.svg --quiet > printed && cat study.svg");
    ASSERT_EQ(drawn.status, 0) << drawn.printed;
    EXPECT_EQ(drawn.printed,
              text_of_file(std::string(GOBO_SOURCE_DIR "/docs/pictures/") + GetParam().picture))
        << "remake it: " << command_ << " --svg docs/pictures/" << GetParam().picture;
}

INSTANTIATE_TEST_SUITE_P(
    Docs, StudyFronts,
    testing::Values(Shown{"ByOperations", "`(gobo study lit --front '[^']*')`", "study.svg"},
                    Shown{"ByChips", "`(gobo study lit --front '[^']*' --gpu [a-z0-9,]*)`",
                          "study_on_gpus.svg"}),
    [](const auto& shown) { return shown.param.name; });

}  // namespace
}  // namespace gobo
