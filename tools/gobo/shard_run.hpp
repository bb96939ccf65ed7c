// What the shards of one run have in common, so that gobo merge joins no others.
#pragma once

#include <string>
#include <vector>

#include "gobo/input.hpp"

namespace gobo {

/// A JSON object: family, dialect, each option given that results hang on, all keys, the build of gobo, and
/// what the family is made of. `family_files` are its own file and its bases, on disk.
[[nodiscard]] std::string run_of_shards(const World& world, const LoadedFamily& family,
                                        const std::vector<std::string>& family_files,
                                        const std::vector<Key>& all);

/// What is another in `run` than in `first`, with both values where they can be read; empty where nothing is.
[[nodiscard]] std::string difference_of_runs(const std::string& first, const std::string& run);

}  // namespace gobo
