// docs/command_line.md has a section for each command, and names no option that a command lacks. The options
// themselves are explained by --help.
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "page.hpp"
#include "reader.hpp"

namespace gobo {
namespace {

using testing::IsEmpty;
using Options = std::set<std::string>;

/// What the page says outside of its examples, by the heading of second degree that it stands under.
std::map<std::string, std::string> sections_of_page() {
    std::map<std::string, std::string> sections;
    std::string heading;
    bool in_example = false;
    for (const std::string& line : lines_of(text_of_file(GOBO_SOURCE_DIR "/docs/command_line.md"))) {
        if (line.starts_with("```")) in_example = !in_example;
        if (line.starts_with("## ")) heading = line.substr(3);
        if (!in_example) sections[heading] += line + "\n";
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

std::string help_of(const std::string& command) {
    Reader reader(GOBO_COMMAND);
    return reader.run("gobo " + command + " --help").printed;
}

/// Each option of a command's help with its explanation: behind its names and value, or on the next line.
std::map<std::string, std::string> explained_options(const std::string& command) {
    // Values that fill their column, `a|b|c`, have a single blank behind them.
    static const std::regex row(R"(  (-\S+)(?:.*?(?:  +|\|\w+ (?=[A-Z])|REQUIRED )(.*))?.*)");
    std::map<std::string, std::string> explanations;
    const std::vector<std::string> lines = lines_of(help_of(command));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (!std::regex_match(lines[i], match, row)) continue;
        const bool goes_on = i + 1 < lines.size() && lines[i + 1].starts_with("      ");
        const std::string explanation = goes_on ? lines[i + 1] : match[2].str();
        for (const std::string& name : options_in(match[1])) explanations[name] = explanation;
    }
    return explanations;
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

/// Options that a section mentions in code, `--all` or `gobo build --max-error X`, and the command, of the
/// section or of the code, that lacks them. Where no command is told, any may have them.
std::vector<std::string> missing_options(const std::string& section_command, const std::string& text,
                                         const std::map<std::string, Options>& offered) {
    static const std::regex code("`([^`]+)`");
    static const std::regex of_command(R"(gobo ([a-z]+)\b.*)");
    std::vector<std::string> missing;
    for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at) {
        const std::string span = (*at)[1];
        std::smatch match;
        const std::string command =
            std::regex_match(span, match, of_command) ? match[1].str() : section_command;
        for (const std::string& option : options_in(span)) {
            bool is_offered = false;
            for (const auto& [name, options] : offered)
                is_offered = is_offered || ((command.empty() || command == name) && options.contains(option));
            if (!is_offered) missing.push_back(fmt::format("gobo {} has no {}", command, option));
        }
    }
    return missing;
}

TEST(CommandLinePage, NamesOnlyOptionsThatThereAre) {
    std::map<std::string, Options> offered;
    for (const std::string& command : offered_commands())
        for (const auto& [option, explanation] : explained_options(command)) offered[command].insert(option);
    ASSERT_EQ(missing_options("list", "`--cuont` `gobo show --count` `--json`", offered),
              (std::vector<std::string>{"gobo list has no --cuont", "gobo show has no --count"}));
    for (const auto& [heading, text] : sections_of_page()) {
        const std::string command = heading.starts_with("gobo ") ? heading.substr(5) : "";
        EXPECT_THAT(missing_options(command, text, offered), IsEmpty()) << "## " << heading;
    }
}

TEST(CommandLinePage, HasASectionForEveryCommandAndNoOther) {
    const std::vector<std::string> commands = offered_commands();
    ASSERT_FALSE(commands.empty());
    Options headings;
    for (const auto& [heading, text] : sections_of_page())
        if (heading.starts_with("gobo ")) headings.insert(heading.substr(5));
    EXPECT_EQ(headings, Options(commands.begin(), commands.end()));
}

TEST(CommandLinePage, ListsEveryOptionThatSelectsKeys) {
    const std::string help = help_of("list");
    const std::size_t begin = help.find("Which keys:\n");
    ASSERT_NE(begin, std::string::npos);
    const std::string group = help.substr(begin, help.find("\n\n", begin) - begin);
    const Options mentioned = options_in(sections_of_page()["Selection"]);
    int listed = 0;
    for (const std::string& line : lines_of(group)) {
        if (!line.starts_with("  -")) continue;
        const std::string option = line.substr(2, line.find(' ', 2) - 2);
        EXPECT_TRUE(mentioned.contains(option)) << option;
        ++listed;
    }
    EXPECT_GT(listed, 5);
}

TEST(Help, ExplainsEveryOption) {
    for (const std::string& command : offered_commands()) {
        const auto options = explained_options(command);
        EXPECT_GE(options.size(), 7U) << "the common options alone are more: " << command;
        for (const auto& [option, explanation] : options)
            EXPECT_GT(explanation.size(), 5U) << "gobo " << command << " " << option;
    }
}

}  // namespace
}  // namespace gobo
