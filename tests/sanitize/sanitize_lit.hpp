// Permutations of `lit`, sanitized with a piece as it is or changed.
#pragma once

#include <string>
#include <vector>

#include "lab/sanitize/sanitize.hpp"

namespace gobo {

/// `to` in place of the first `from` of a piece; nothing where `piece` is empty.
struct Change {
    std::string piece;  ///< "fog/linear.glsl"
    std::string from;
    std::string to;
};

/// What sanitizing the key gives; failing any step, or a change of nothing, fails the test.
[[nodiscard]] sanitize::SanitizeReport sanitized_lit(const std::string& key,
                                                     const sanitize::SanitizeOptions& options,
                                                     const Change& change);
[[nodiscard]] std::vector<std::string> messages_of(const sanitize::SanitizeReport& report);

}  // namespace gobo
