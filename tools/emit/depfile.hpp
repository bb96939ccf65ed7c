// What a build system must know: which files an output depends on.
#pragma once

#include <string>
#include <vector>

namespace gobo {

/// A rule in the syntax of make (and so of Ninja and CMake): the outputs depend on the files, each named
/// once, in the order given. Blanks, '#' and '$' in names are escaped.
[[nodiscard]] std::string emit_depfile(const std::vector<std::string>& outputs,
                                       const std::vector<std::string>& files);

}  // namespace gobo
