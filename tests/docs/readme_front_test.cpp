// The front that the README shows is that of the study which is shipped.
#include <regex>

#include <gtest/gtest.h>

#include "page.hpp"
#include "reader.hpp"

namespace gobo {
namespace {

/// The command that the README prints beside its table.
std::string command_in(const std::string& readme) {
    static const std::regex command("`(gobo study lit --front '[^']*')");
    std::smatch found;
    return std::regex_search(readme, found, command) ? found[1].str() : "";
}

TEST(ReadmeFront, IsWhatItsCommandPrints) {
    const std::string readme = text_of_file(GOBO_SOURCE_DIR "/README.md");
    const std::string command = command_in(readme);
    ASSERT_NE(command, "") << "the README prints no such command";
    Reader reader(GOBO_COMMAND);
    const CommandResult table = reader.run(command);
    ASSERT_EQ(table.status, 0) << table.printed;
    EXPECT_NE(readme.find(table.printed), std::string::npos) << "put this into the README:\n"
                                                             << table.printed;
}

TEST(ReadmeFront, IsDrawnAsItsCommandDrawsIt) {
    const std::string command = command_in(text_of_file(GOBO_SOURCE_DIR "/README.md"));
    ASSERT_NE(command, "");
    Reader reader(GOBO_COMMAND);
    const CommandResult drawn = reader.run(command + " --svg study.svg --quiet > printed && cat study.svg");
    ASSERT_EQ(drawn.status, 0) << drawn.printed;
    EXPECT_EQ(drawn.printed, text_of_file(GOBO_SOURCE_DIR "/docs/pictures/study.svg"))
        << "remake it: " << command << " --svg docs/pictures/study.svg";
}

}  // namespace
}  // namespace gobo
