// Every subcommand: its options are added to the application, and a function that runs it comes back.
#pragma once

#include "gobo/command.hpp"

namespace gobo {

[[nodiscard]] Command list_command(CLI::App& gobo);
[[nodiscard]] Command show_command(CLI::App& gobo);
[[nodiscard]] Command check_command(CLI::App& gobo);
[[nodiscard]] Command reflect_command(CLI::App& gobo);
[[nodiscard]] Command build_command(CLI::App& gobo);
[[nodiscard]] Command scene_command(CLI::App& gobo);
[[nodiscard]] Command library_command(CLI::App& gobo);

}  // namespace gobo
