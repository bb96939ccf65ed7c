// What else the description of commands gives: the manual page, and the completions of shells.
#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "core/text.hpp"
#include "gobo/application.hpp"

namespace gobo {
namespace {

/// Text as groff has it: dashes and quotes that can be copied, no line that looks like a request.
std::string groff(std::string_view text) {
    static const std::map<char, std::string_view> kEscapes = {
        {'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'`', "\\(ga"}, {'.', "\\&."}};
    std::string result;
    for (const char character : text) {
        const auto escape = kEscapes.find(character);
        result += escape == kEscapes.end() ? std::string_view(&character, 1) : escape->second;
    }
    return result;
}

std::string options_text(const std::vector<Option>& options) {
    std::string text;
    for (const Option& option : options) {
        if (option.rule.hidden) continue;
        const std::string names = join(split(groff(option.names), ','), "\\fR, \\fB");
        const std::string value = option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", groff(option.value));
        text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", names, value, groff(described(option)));
    }
    return text;
}

std::string examples_text(const std::string& examples) {
    return fmt::format(".PP\n.nf\n{}\n.fi\n", groff(examples));
}

std::string command_text(const Command& command) {
    std::string usage = "gobo " + command.title.name + (command.run ? " [OPTIONS]" : "");
    for (const Option& option : command.options)
        if (option.is_argument()) usage += " " + (option.value.empty() ? option.names : option.value);
    std::string text = fmt::format(".SS {}\n{}.\n", groff(usage), groff(command.title.summary));
    if (!command.run) return text + "See\n.BR gobo\\-lab (1).\n";
    text += options_text(command.options) + ".PP\nAlso those under";
    for (const OptionGroup& group : command.groups) text += fmt::format(" \\(lq{}\\(rq", group.heading);
    text += fmt::format(" below.\n.PP\n{}\n", groff(command.notes));
    return text + examples_text(command.examples);
}

}  // namespace

std::string manual_page(const Application& application) {
    std::string text = fmt::format(
        ".TH {0} 1 \"\" \"gobo {1}\" \"User Commands\"\n.SH NAME\n{0} \\- {2}\n.SH SYNOPSIS\n.B gobo\n"
        ".I COMMAND\n[OPTIONS]\n.SH DESCRIPTION\n{3}\n.SH COMMANDS\n",
        groff(application.name), GOBO_VERSION, groff(application.description), groff(kTerms));
    std::map<std::string, std::string> groups;
    for (const Command& command : application.commands) {
        if (command.hidden) continue;
        text += command_text(command);
        for (const OptionGroup& group : command.groups) groups[group.heading] = options_text(group.options);
    }
    text += ".SH OPTIONS OF SEVERAL COMMANDS\n";
    for (const auto& [heading, options] : groups) text += fmt::format(".SS {}\n{}", heading, options);
    return text + fmt::format(".SH EXIT STATUS\n{}\n.SH EXAMPLES\n{}", groff(kExitStatus),
                              examples_text(application.examples));
}

std::string completions(const Application& application, const std::vector<std::string>& words,
                        const std::vector<std::string>& families) {
    std::string text;
    const auto offer = [&](std::string_view name, std::string_view what) {
        if (name.starts_with(words.back())) text += fmt::format("{}\t{}\n", name, what);
    };
    if (words.size() == 1) {
        for (const Command& command : application.commands)
            if (!command.hidden) offer(command.title.name, command.title.summary);
        return text;
    }
    const auto command = std::find_if(application.commands.begin(), application.commands.end(),
                                      [&](const Command& each) { return each.title.name == words.front(); });
    if (command == application.commands.end()) return text;
    std::vector<Option> options = command->options;
    for (const OptionGroup& group : command->groups)
        options.insert(options.end(), group.options.begin(), group.options.end());
    const std::string& before = words[words.size() - 2];
    for (const Option& option : options) {
        const std::vector<std::string> names = split(option.names, ',');
        if (option.is_flag() || std::find(names.begin(), names.end(), before) == names.end()) continue;
        const std::vector<std::string> values = split(option.value, '|');
        for (const std::string& value : values)
            if (values.size() > 1 && !std::isupper(static_cast<unsigned char>(value.front())))
                offer(value, "");
        return text;
    }
    if (!words.back().starts_with('-')) {
        for (const Option& option : options)
            if (option.is_argument() && (option.names + option.value).find("FAMILY") != std::string::npos)
                for (const std::string& family : families) offer(family, "");
        return text;
    }
    offer("--help", "Print this help and stop");
    for (const Option& option : options)
        for (const std::string& name : split(option.names, ','))
            if (!option.is_argument() && !option.rule.hidden) offer(name, option.help);
    return text;
}

}  // namespace gobo
