// The command line.
#pragma once

#include <optional>
#include <string>

#include "renderer.hpp"

namespace viewer {

struct Options {
    std::string scene;
    std::string family = "lit";  ///< or "pbr"
    bool headless = false;
    int frames = 1;
    double turn = -1;    ///< degrees from one frame to the next; below 0: once around in all
    std::string keys;    ///< one is pressed before each frame but the first
    std::string folder;  ///< for pictures; empty: none
    std::string record;  ///< empty: viewer.keys, of pbr viewer_pbr.keys
    std::string reload;  ///< a socket of gobo watch; empty: none
    Size size;
};

/// The options, or the exit status with which to leave at once.
struct CommandLine {
    Options options;
    std::optional<int> exit_status;
};

[[nodiscard]] CommandLine read_command_line(int argc, char** argv);

}  // namespace viewer
