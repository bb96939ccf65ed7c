// What gobo and gobo-lab share: the command line is read, one command runs, its outcome is printed.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gobo/command.hpp"

namespace gobo {

struct Program {
    std::string name;
    std::string description;
    std::string footer;
    std::function<std::vector<Command>(CLI::App&)> add_commands;
    std::vector<std::pair<std::string, std::string>> elsewhere;  ///< commands of gobo-lab, with what they do
    MeasureQualities measure;
};

/// The exit status of the process.
[[nodiscard]] int run_program(const Program& program, int count, char** arguments);

}  // namespace gobo
