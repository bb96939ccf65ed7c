// One permutation as a command names it: a family and a key, or loose shader files.
#pragma once

#include <string>
#include <vector>

#include "gobo/command.hpp"

namespace gobo {

/// The family with its one permutation, whichever way it was named.
struct Subject {
    Family family;
    Composition composition;
    bool are_files = false;  ///< loose files: there is no key to speak of
};

/// `names` are FAMILY [KEY], or files told by their ends.
[[nodiscard]] Result<Subject> load_subject(const World& world, const std::vector<std::string>& names,
                                           const CommonOptions& options, const std::string& dialect_name);

}  // namespace gobo
