// Reads the command line: the only file that knows CLI11, which takes seconds to compile.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/text.hpp"
#include "gobo/application.hpp"

namespace gobo {
namespace {

/// "1 to 8", "above 0"; nothing where every number will do.
std::string range_text(const OptionRule& rule) {
    if (rule.least == kPositive.least) return "above 0";
    if (std::isfinite(rule.most)) return fmt::format("{} to {}", rule.least, rule.most);
    return std::isfinite(rule.least) ? fmt::format("at least {}", rule.least) : "";
}

/// What is wrong with the text of a number; empty where it is one of the type and within its range.
template <class Number>
std::string number_fault(const OptionRule& rule, const std::string& text) {
    const auto value = number_from<Number>(text);
    const double number = value ? static_cast<double>(*value) : std::nan("");
    if (std::isfinite(number) && number >= rule.least && number <= rule.most) return {};
    const std::string range = range_text(rule);
    const char* const before = range.empty() || range == "above 0" ? " "
                               : std::isfinite(rule.most)          ? " from "
                                                                   : " of ";
    return fmt::format("'{}' is not a {}number{}{}", text, std::is_integral_v<Number> ? "whole " : "",
                       range.empty() ? "" : before, range);
}

/// Whether the value is the name of a file or folder.
bool names_path(const Option& option) {
    const std::string& value = option.value;
    return value == "DIR" || value == "FOLDER" || value.starts_with("FILE") || value.starts_with("MAP");
}

/// What is wrong with the text of a value; empty where it can be the option's.
std::string value_fault(const Option& option, const std::string& text) {
    return std::visit(
        [&](const auto* target) -> std::string {
            using Value = std::decay_t<decltype(*target)>;
            if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>)
                return number_fault<Value>(option.rule, text);
            else if (names_path(option))
                return text.empty() ? "the name is empty" : "";
            else if (!trim(text).empty())
                return "";
            else  // a script's variable that is not set
                return option.is_argument() ? "" : "the value is empty: give one, or leave the option out";
        },
        option.target);
}

std::string default_text(const Option& option) {
    return std::visit(
        [](const auto* target) -> std::string {
            using Value = std::decay_t<decltype(*target)>;
            if constexpr (std::is_same_v<Value, std::string>)
                return *target;
            else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
                return join(*target, " and ");
            else
                return *target > Value() ? fmt::format("{}", *target) : "";
        },
        option.target);
}

void add_option(CLI::App& app, const Option& option, const std::string& heading) {
    const OptionRule& rule = option.rule;
    CLI::Option* added = std::visit(
        [&](auto* target) {
            if constexpr (std::is_same_v<decltype(target), bool*>)
                return app.add_flag(option.names, *target);
            else
                return app.add_option(option.names, *target);
        },
        option.target);
    added->description(described(option))->group(rule.hidden ? "" : heading)->required(rule.required);
    if (!option.is_flag()) {
        const char* const blank = option.value.empty() || !rule.required ? "" : " ";
        added->option_text(option.value + blank + (rule.required ? "REQUIRED" : ""));
        added->type_name(option.value);
        if (!option.is_argument()) added->allow_extra_args(false);
        added->check(
            CLI::Validator([option](const std::string& text) { return value_fault(option, text); }, ""));
    } else {
        added->option_text(" ");  // the description tells what goes with it
    }
    if (rule.one_of) added->check(CLI::IsMember(split(option.value, '|')));
}

/// Between options that are all there.
void add_relations(CLI::App& app, const Option& option) {
    if (option.rule.needs.empty() && option.rule.excludes.empty()) return;
    CLI::Option* added = app.get_option(split(option.names, ',').back());
    if (!option.rule.needs.empty()) added->needs(app.get_option(option.rule.needs));
    for (const std::string& name : split(option.rule.excludes, ' ')) added->excludes(app.get_option(name));
}

void add_command(CLI::App& app, const Command& command) {
    const std::string lab = command.run ? "" : " (gobo-lab)";
    CLI::App* added = app.add_subcommand(command.title.name, command.title.summary + lab);
    if (command.hidden) added->group("");
    for (const Option& option : command.options) add_option(*added, option, "Options");
    for (const OptionGroup& group : command.groups)
        for (const Option& option : group.options) add_option(*added, option, group.heading);
    for (const Option& option : command.options) add_relations(*added, option);
    for (const OptionGroup& group : command.groups)
        for (const Option& option : group.options) add_relations(*added, option);
    added->footer(fmt::format("{}{}Examples:\n{}", command.notes, command.notes.empty() ? "" : "\n\n",
                              command.examples));
}

/// Why the command line was refused. CLI11 lists unexpected arguments in any order and suggests nothing: the
/// first is named here.
tl::unexpected<Diagnostics> refuse(const CLI::App& app, const CLI::ParseError& error,
                                   const std::vector<std::string>& arguments) {
    const auto commands = app.get_subcommands();
    const CLI::App& chosen = commands.empty() ? app : *commands.front();
    const std::string name = commands.empty() ? "gobo" : "gobo " + chosen.get_name();
    const std::string see_help = fmt::format("see '{} --help'", name);
    if (!commands.empty() && arguments.front().starts_with('-'))
        return fail(Fault::usage, fmt::format("'{}' stands before the command", arguments.front()),
                    fmt::format("write it behind: {} {}", name, arguments.front()));
    if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr)
        return fail(Fault::usage, error.what(), see_help);
    std::vector<std::string> known;
    for (const CLI::Option* option : chosen.get_options())
        for (const std::string& long_name : option->get_lnames()) known.push_back("--" + long_name);
    for (const std::string& argument : arguments) {
        const std::string option = argument.substr(0, argument.find('='));
        if (option == "--") break;
        if (option.size() < 2 || !option.starts_with('-') || chosen.get_option_no_throw(option) != nullptr)
            continue;
        const auto near = nearest(option, known);
        std::string help = near ? fmt::format("did you mean '{}'?", *near) : see_help;
        if (option == "--retired" && chosen.get_option_no_throw("--excluded") != nullptr)
            help = "'--retired' is now '--excluded'";
        return fail(Fault::usage, fmt::format("'{}' has no option '{}'", name, option), help);
    }
    const std::vector<std::string> rest = app.remaining(true);
    return fail(Fault::usage, fmt::format("unexpected argument '{}'", rest.empty() ? "" : rest.front()),
                see_help);
}

/// The arguments of `gobo build` with what glslc calls its options replaced by gobo's names.
std::vector<std::string> with_own_names(std::vector<std::string> arguments) {
    if (arguments.front() != "build") return arguments;
    const std::map<std::string_view, std::string_view> names = {
        {"-MD", "--glslc-depfile"}, {"-MF", "--depfile"}, {"-MT", "--depfile-target"}};
    for (std::string& argument : arguments)
        if (const auto own = names.find(argument); own != names.end()) argument = own->second;
    return arguments;
}

}  // namespace

std::string described(const Option& option) {
    std::vector<std::string> details;
    const bool is_list = std::holds_alternative<std::vector<std::string>*>(option.target);
    if (is_list && !option.is_argument()) details.emplace_back("repeatable");
    details.push_back(range_text(option.rule));
    if (const std::string text = default_text(option); !text.empty()) details.push_back("by default " + text);
    if (!option.rule.needs.empty()) details.push_back("with " + option.rule.needs);
    if (!option.rule.excludes.empty())
        details.push_back("without " + join(split(option.rule.excludes, ' '), ", "));
    std::erase(details, "");
    return details.empty() ? option.help : fmt::format("{} ({})", option.help, join(details, "; "));
}

Result<CommandLine> read_command_line(const Application& application,
                                      const std::vector<std::string>& arguments) {
    std::vector<std::string> names;
    for (const Command& command : application.commands) names.push_back(command.title.name);
    if (arguments.empty()) return fail(Fault::usage, "no command is given", "see 'gobo --help'");
    if (!arguments.front().starts_with('-') &&
        std::find(names.begin(), names.end(), arguments.front()) == names.end())
        return fail(Fault::usage, fmt::format("there is no command '{}'", arguments.front()),
                    suggestion(arguments.front(), names));

    CLI::App app(application.name + " " + application.description, "gobo");
    app.set_help_flag("-h,--help", "Print this help and stop");
    app.set_version_flag("--version", fmt::format("{} {}", application.name, GOBO_VERSION),
                         "Print the version and stop");
    app.require_subcommand(1);
    app.footer(
        fmt::format("{}\n\nExit status: {}\n\nExamples:\n{}", kTerms, kExitStatus, application.examples));
    for (const Command& command : application.commands) add_command(app, command);
    try {
        std::vector<std::string> words = with_own_names(arguments);
        std::ranges::reverse(words);  // as CLI11 has it
        app.parse(std::move(words));
    } catch (const CLI::Success& asked) {
        std::ostringstream text;
        app.exit(asked, text, text);
        std::string help = text.str();
        for (auto at = help.find("\n\n\n"); at != std::string::npos; at = help.find("\n\n\n"))
            help.erase(at, 1);
        return CommandLine{nullptr, std::move(help)};
    } catch (const CLI::ParseError& error) {
        return refuse(app, error, arguments);
    }
    const auto chosen = std::ranges::find_if(
        application.commands, [&](const Command& command) { return app.got_subcommand(command.title.name); });
    CommandLine line{&*chosen};
    for (const CLI::Option* option : app.get_subcommands().front()->get_options())
        if (option->count() > 0 && !option->get_positional())
            line.given[option->get_name()] = join(option->results(), " ");
    return line;
}

}  // namespace gobo
