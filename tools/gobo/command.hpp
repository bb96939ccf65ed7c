// A command as data: its name, what it takes and what it does. The command line is read by this description,
// and the help, the manual page and the completions of shells say what stands here.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>  // commands share their options with what runs them
#include <string>
#include <variant>
#include <vector>

#include "core/bytes.hpp"

namespace gobo {

struct World;

/// What is asked of an option beside the type of its target.
struct OptionRule {
    bool required = false;
    bool hidden = false;
    bool one_of = false;  ///< a word of `value`
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    std::string needs = {};     ///< an option that must be given too
    std::string excludes = {};  ///< those that must not, with blanks between
};

/// An option, or an argument where its name has no dash. A bool is a flag; a vector takes one value each
/// time. What the target holds at first is the default: the help tells it, unless it is empty or not above 0.
struct Option {
    std::string names;  ///< "-o,--output" or "FAMILY"
    std::string value;  ///< stands for the value: "DIR"; words in small letters can be typed: "N|all|none"
    std::string help;
    std::variant<bool*, int*, std::size_t*, double*, std::string*, std::vector<std::string>*> target;
    OptionRule rule = {};

    [[nodiscard]] bool is_argument() const { return !names.starts_with('-'); }
    [[nodiscard]] bool is_flag() const { return std::holds_alternative<bool*>(target); }
};

inline const OptionRule kRequired = {.required = true};
inline const OptionRule kHidden = {.hidden = true};
inline const OptionRule kOneOf = {.one_of = true};
inline const OptionRule kNotNegative = {.least = 0};
inline const OptionRule kPositive = {.least = std::numeric_limits<double>::min()};
[[nodiscard]] inline OptionRule between(double least, double most) {
    return {.least = least, .most = most};
}

/// The options that a command line gives, by their last name, with their values.
using GivenOptions = std::map<std::string, std::string>;

/// Options that several commands share, under a heading of their own.
struct OptionGroup {
    std::string heading;
    std::vector<Option> options;
};

struct Title {
    std::string name;
    std::string summary;
};

struct OutputFile {
    std::string path;
    std::string content;
};
GOBO_FIELDS(OutputFile, path, content)

/// What a command leaves: its data for standard output, and messages for standard error.
struct Outcome {
    std::string output;
    Diagnostics diagnostics = {};
    std::string summary = {};            ///< a closing line for standard error, unless --quiet
    std::vector<OutputFile> files = {};  ///< to be written together, the one that others go by last
    int compiled = -1;  ///< how many stages had to be compiled, where a cache was asked first
};
GOBO_FIELDS(Outcome, output, diagnostics, summary, files, compiled)

struct Command {
    Title title;
    std::vector<Option> options = {};
    std::vector<OptionGroup> groups = {};                        ///< beside the options of every command
    std::string examples = {};                                   ///< lines
    std::function<Result<Outcome>(const World&)> run = nullptr;  ///< null: gobo-lab does it
    std::string notes = {};
    bool hidden = false;
    /// The same arguments and files give the same outcome, which may be kept; the command writes nothing.
    bool is_repeatable = false;
    bool manages_cache = false;
};

/// The command, whose outcome depends on its arguments and on files that it reads through World::disk alone.
[[nodiscard]] inline Command repeatable(Command command) {
    command.is_repeatable = true;
    return command;
}

}  // namespace gobo
