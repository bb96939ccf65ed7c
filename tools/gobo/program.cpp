#include "gobo/program.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "core/shipped_files.hpp"
#include "core/text.hpp"
#include "gobo/hand_over.hpp"

namespace gobo {
namespace {

constexpr std::string_view kVersion = GOBO_VERSION;

constexpr int kUsageStatus = 2;

bool wants_color(const std::vector<std::string>& arguments) {
    bool color = isatty(STDERR_FILENO) != 0;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const bool next = arguments[i] == "--color" && i + 1 < arguments.size();
        const std::string& value = next ? arguments[i + 1] : arguments[i];
        if (next && value == "always") color = true;
        if (next && value == "never") color = false;
        if (value == "--color=always") color = true;
        if (value == "--color=never") color = false;
    }
    return color;
}

void print(const Diagnostics& diagnostics, bool color) {
    for (const Diagnostic& diagnostic : diagnostics) std::fputs(to_text(diagnostic, color).c_str(), stderr);
}

/// A full disk shows when the stream is flushed.
Diagnostics write_output(const std::string& text) {
    const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (is_written && std::fflush(stdout) == 0) return {};
    return fail(Fault::file, fmt::format("standard output cannot be written: {}", std::strerror(errno)))
        .value();
}

/// An unknown command is answered with the nearest one; CLI11 would only say that a subcommand is required.
std::optional<Diagnostics> unknown_command(const CLI::App& app, const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments.front().starts_with('-')) return std::nullopt;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == arguments.front()) return std::nullopt;
        names.push_back(command->get_name());
    }
    return fail(Fault::usage, fmt::format("there is no command '{}'", arguments.front()),
                suggestion(arguments.front(), names))
        .value();
}

/// The first option that the command does not have; nothing where all are known.
std::optional<std::string> unknown_option(const CLI::App& command,
                                          const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments) {
        const std::string name = argument.substr(0, argument.find('='));
        if (name == "--") return std::nullopt;
        if (name.size() > 1 && name.starts_with('-') && command.get_option_no_throw(name) == nullptr)
            return name;
    }
    return std::nullopt;
}

std::vector<std::string> long_options(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// CLI11 lists unexpected arguments in any order and suggests nothing, so unknown options are named here.
int refuse(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& arguments,
           bool color) {
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string name = chosen.empty() ? "gobo" : "gobo " + command.get_name();
    const auto unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr
                             ? unknown_option(command, arguments)
                             : std::nullopt;
    if (unknown) {
        const auto near = nearest(*unknown, long_options(command));
        print(fail(Fault::usage, fmt::format("'{}' has no option '{}'", name, *unknown),
                   near ? fmt::format("did you mean '{}'?", *near) : fmt::format("see '{} --help'", name))
                  .value(),
              color);
    } else {
        print(fail(Fault::usage, error.what(), fmt::format("see '{} --help'", name)).value(), color);
    }
    return kUsageStatus;
}

/// The last thing a command does: nothing but what it says where it needs the lab and the lab is not there.
int finish(Outcome outcome, bool is_quiet, bool color) {
    Diagnostics written = write_output(outcome.output);
    outcome.diagnostics.insert(outcome.diagnostics.end(), written.begin(), written.end());
    print(outcome.diagnostics, color);
    if (!outcome.summary.empty() && !is_quiet) std::fputs((outcome.summary + "\n").c_str(), stderr);
    return exit_status(outcome.diagnostics);
}

int run(const Program& program, const std::vector<std::string>& arguments) {
    const bool color = wants_color(arguments);
    CLI::App app(program.description, program.name);
    app.set_version_flag("--version", fmt::format("{} {}", program.name, kVersion));
    app.require_subcommand(1);
    app.footer(program.footer);
    const std::vector<Command> commands = program.add_commands(app);
    for (const auto& [name, description] : program.elsewhere) {
        if (!arguments.empty() && arguments.front() == name)
            return finish({{}, hand_over(fmt::format("gobo {}", name), arguments), {}}, true, color);
        app.add_subcommand(name, description);
    }
    if (const auto unknown = unknown_command(app, arguments)) {
        print(*unknown, color);
        return kUsageStatus;
    }
    try {
        app.parse(
            std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // reversed, as CLI11 has it
    } catch (const CLI::Success& asked) {
        return app.exit(asked);  // --help, --version
    } catch (const CLI::ParseError& error) {
        return refuse(app, error, arguments, color);
    }
    DiskFileSystem disk;
    MemoryFileSystem shipped(shipped_files());
    for (const Command& command : commands) {
        if (!command.app->parsed()) continue;
        Outcome outcome = command.run({disk, shipped, program.measure});
        const Diagnostic* first = outcome.diagnostics.empty() ? nullptr : &outcome.diagnostics.front();
        if (first != nullptr && first->fault == Fault::needs_lab)
            outcome.diagnostics = hand_over(first->message, arguments);
        return finish(std::move(outcome), command.app->count("--quiet") > 0, color);
    }
    return kUsageStatus;
}

}  // namespace

int run_program(const Program& program, int count, char** arguments) {
    try {
        return run(program, {arguments + 1, arguments + count});
    } catch (const std::exception& error) {
        fmt::print(stderr, "gobo: error: internal fault: {}\n", error.what());
        return 4;
    }
}

}  // namespace gobo
