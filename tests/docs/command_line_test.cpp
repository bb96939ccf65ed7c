// The options that docs/command_line.md lists are those that the commands have.
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "page.hpp"
#include "reader.hpp"

namespace gobo {
namespace {

using Options = std::set<std::string>;

/// Lines of the page by the heading of second degree that they stand under.
std::map<std::string, std::vector<std::string>> sections_of_page() {
    std::map<std::string, std::vector<std::string>> sections;
    std::string heading;
    for (const std::string& line : lines_of(text_of_file(GOBO_SOURCE_DIR "/docs/command_line.md"))) {
        if (line.starts_with("## ")) heading = line.substr(3);
        sections[heading].push_back(line);
    }
    return sections;
}

Options options_in(const std::string& text) {
    static const std::regex option(R"((?:^|[\s`,])(--?[A-Za-z][\w-]*))");
    Options found;
    for (std::sregex_iterator at(text.begin(), text.end(), option), end; at != end; ++at)
        found.insert((*at)[1]);
    return found;
}

/// The options in the first column of a section's tables.
Options listed_in(const std::vector<std::string>& section) {
    Options listed;
    for (const std::string& line : section) {
        if (!line.starts_with("| `-")) continue;
        listed.merge(options_in(line.substr(0, line.find(" | "))));
    }
    return listed;
}

/// Those that a command's section lists, and those of the sections that it refers to as its options.
Options documented(const std::string& command) {
    const auto sections = sections_of_page();
    const auto section = sections.find("gobo " + command);
    if (section == sections.end()) return {};
    Options options = listed_in(section->second);
    for (const std::string& line : section->second) {
        if (line.find("(#selection)") != std::string::npos)
            options.merge(listed_in(sections.at("Selection")));
        if (line.find("(#dialect)") != std::string::npos) options.merge(listed_in(sections.at("Dialect")));
        if (line.find("(#common-options)") != std::string::npos)
            options.merge(listed_in(sections.at("Common options")));
    }
    return options;
}

std::string help_of(const std::string& command) {
    Reader reader(GOBO_COMMAND);
    return reader.run("gobo " + command + " --help").printed;
}

/// In the help, an option's line begins with two blanks and its names.
Options offered(const std::string& command) {
    Options options;
    for (const std::string& line : lines_of(help_of(command))) {
        if (!line.starts_with("  -")) continue;
        options.merge(options_in(line.substr(0, line.find(' ', 2))));
    }
    return options;
}

std::vector<std::string> offered_commands() {
    static const std::regex row(R"(  ([a-z]+) .*)");
    std::vector<std::string> commands;
    bool within = false;
    for (const std::string& line : lines_of(help_of(""))) {
        std::smatch match;
        if (line.empty()) within = false;
        if (within && std::regex_match(line, match, row)) commands.push_back(match[1]);
        if (line == "Subcommands:") within = true;
    }
    return commands;
}

TEST(CommandLinePage, ListsEveryOptionOfEveryCommandAndNoOther) {
    const std::vector<std::string> commands = offered_commands();
    ASSERT_FALSE(commands.empty());
    for (const std::string& command : commands) {
        EXPECT_GE(offered(command).size(), 7U) << "the common options alone are more: " << command;
        EXPECT_EQ(documented(command), offered(command)) << "docs/command_line.md, ## gobo " << command;
    }
}

TEST(CommandLinePage, DescribesNoCommandThatIsMissing) {
    const std::vector<std::string> commands = offered_commands();
    const std::set<std::string> known(commands.begin(), commands.end());
    for (const auto& [heading, lines] : sections_of_page()) {
        if (heading.starts_with("gobo ")) {
            EXPECT_TRUE(known.contains(heading.substr(5))) << heading;
        }
    }
}

}  // namespace
}  // namespace gobo
