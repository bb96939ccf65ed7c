// The front that docs/study.md shows is that of the study which is shipped.
#include <regex>

#include <gtest/gtest.h>

#include "page.hpp"
#include "reader.hpp"

namespace gobo {
namespace {

/// The command that the page prints beside its table.
std::string command_in(const std::string& page) {
    static const std::regex command("`(gobo study lit --front '[^']*')");
    std::smatch found;
    return std::regex_search(page, found, command) ? found[1].str() : "";
}

TEST(StudyFront, IsWhatItsCommandPrints) {
    const std::string page = text_of_file(GOBO_SOURCE_DIR "/docs/study.md");
    const std::string command = command_in(page);
    ASSERT_NE(command, "") << "the page prints no such command";
    Reader reader(GOBO_COMMAND);
    const CommandResult table = reader.run(command);
    ASSERT_EQ(table.status, 0) << table.printed;
    EXPECT_NE(page.find(table.printed), std::string::npos) << "put this into the page:\n" << table.printed;
}

TEST(StudyFront, IsDrawnAsItsCommandDrawsIt) {
    const std::string command = command_in(text_of_file(GOBO_SOURCE_DIR "/docs/study.md"));
    ASSERT_NE(command, "");
    Reader reader(GOBO_COMMAND);
    const CommandResult drawn = reader.run(command + " --svg study.svg --quiet > printed && cat study.svg");
    ASSERT_EQ(drawn.status, 0) << drawn.printed;
    EXPECT_EQ(drawn.printed, text_of_file(GOBO_SOURCE_DIR "/docs/pictures/study.svg"))
        << "remake it: " << command << " --svg docs/pictures/study.svg";
}

}  // namespace
}  // namespace gobo
