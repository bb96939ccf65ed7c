// The commands of gobo-lab.
#pragma once

#include "gobo/commands.hpp"

namespace gobo {

[[nodiscard]] Command eval_command();
[[nodiscard]] Command test_command();
[[nodiscard]] Command sanitize_command();
[[nodiscard]] Command probe_command();
[[nodiscard]] Command render_command();
[[nodiscard]] Command study_command();

struct TestOptions : SelectionOptions {
    std::string folder;  ///< for the worst points of keys that fail; empty: they are not kept
    std::string shard;
    std::string figures_file;
    bool render = false;
    std::string backend = "osmesa";
};

/// gobo test --render: draws every permutation and compares each picture with its evaluation. A picture that
/// fails is an error for its key, and three images in the folder. `validated` holds the SPIR-V of every
/// stage.
[[nodiscard]] Result<Outcome> compare_pictures(const World& world, const TestOptions& options,
                                               const Family& family, const Composition& composition,
                                               const Validated& validated);

}  // namespace gobo
