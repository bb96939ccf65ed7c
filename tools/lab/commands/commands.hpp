// The commands of gobo-lab, as gobo/commands.hpp has those of gobo.
#pragma once

#include "gobo/command.hpp"

namespace gobo {

[[nodiscard]] Command eval_command(CLI::App& gobo);
[[nodiscard]] Command test_command(CLI::App& gobo);
[[nodiscard]] Command sanitize_command(CLI::App& gobo);
[[nodiscard]] Command probe_command(CLI::App& gobo);
[[nodiscard]] Command render_command(CLI::App& gobo);
[[nodiscard]] Command study_command(CLI::App& gobo);

}  // namespace gobo
