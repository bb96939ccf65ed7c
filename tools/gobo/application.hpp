// What gobo and gobo-lab share: the command line is read, one command runs, its outcome is printed.
#pragma once

#include "gobo/command.hpp"
#include "gobo/input.hpp"

namespace gobo {

struct Application {
    std::string name;
    std::string description;  ///< goes on after the name
    std::string examples;
    std::vector<Command> commands;
    MeasureQualities measure = {};  ///< where it is not there gobo-lab does it
};

/// The exit status of the process.
[[nodiscard]] int run_application(const Application& application, int count, char** arguments);

/// Writes the files of an outcome, and says in its summary what was new.
[[nodiscard]] Result<Outcome> with_files_written(Outcome outcome);

inline constexpr const char* kTerms =
    "A family is a set of shaders that share templates: lit, or a .toml file of your own. A key, such as "
    "'fog=linear point=3', chooses one permutation of it.";
inline constexpr const char* kExitStatus =
    "0 fine, 1 the input has errors or a check failed, 2 wrong usage, 3 a file could not be read or written, "
    "4 a bug in gobo.";

/// The command that was chosen, its options' targets filled in; none where --help or --version asked for
/// `text`.
struct CommandLine {
    const Command* command = nullptr;
    std::string text = {};
    GivenOptions given = {};
};
/// Fault::usage for what no command has.
[[nodiscard]] Result<CommandLine> read_command_line(const Application& application,
                                                    const std::vector<std::string>& arguments);

/// The help of an option with its limits and its default.
[[nodiscard]] std::string described(const Option& option);

/// The manual page, for man.
[[nodiscard]] std::string manual_page(const Application& application);

/// What the last of the words after the program's name may become: one a line, a tab, what it does. Nothing
/// where it is a file.
[[nodiscard]] std::string completions(const Application& application, const std::vector<std::string>& words,
                                      const std::vector<std::string>& families);

}  // namespace gobo
