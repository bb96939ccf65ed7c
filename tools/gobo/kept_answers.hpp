// The cache of a run: of stages and programs, and of whole answers where nothing changed at all.
#pragma once

#include <string>
#include <vector>

#include "core/result_cache.hpp"
#include "gobo/command.hpp"
#include "gobo/input.hpp"

namespace gobo {

/// The folder of the cache: --cache, else GOBO_CACHE_DIR; empty where neither names one.
[[nodiscard]] std::string cache_folder(const CommonOptions& options);

/// Runs a command with the cache, if there is one. A command that depends on its arguments and files alone
/// (Command::is_repeatable) is not run again where all its files are as they were: what it answered then,
/// error or not, is answered again. `program` is the program's name. Where the cache cannot be written a
/// warning goes to `warnings`.
[[nodiscard]] Result<Outcome> run_with_cache(const Command& command, const World& world,
                                             const std::string& program,
                                             const std::vector<std::string>& arguments,
                                             Diagnostics& warnings);

}  // namespace gobo
