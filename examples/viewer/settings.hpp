// What the keyboard toggles.
#pragma once

#include <string>

#include "lit.hpp"

namespace viewer {

/// The user's choices, which override what the scene needs.
struct Settings {
    bool fog = true;
    bool toon = false;
    bool directional = true;
    bool point = true;
    bool spot = true;
    lit::Shading shading = lit::Shading::fragment;
};

/// Applies a key of the keyboard: what it did ("fog off"); empty where it does nothing.
[[nodiscard]] std::string press(char key, Settings& settings);

/// A line for each key that does something.
[[nodiscard]] std::string help_text();

}  // namespace viewer
