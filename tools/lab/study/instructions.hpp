// How many instructions a fragment takes, counted by callgrind: slow, but the same in every run.
#pragma once

#include <functional>
#include <string>

#include "lab/study/study.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {

/// Draws the plan's first scene once, by a key, and gives the fragments drawn. What callgrind watches.
[[nodiscard]] Result<double> draw_once(const FileSystem& shipped, const Family& family,
                                       const SearchPath& search, const StudyPlan& plan,
                                       const Context& context, const Key& key, int width, int height);

/// The command line, without valgrind, that draws a key once at a size and prints "fragments N".
using DrawCommand = std::function<std::string(const std::string& key, int width, int height)>;

/// Adds the instructions of a fragment - the slope between two sizes - to each timed key of the combination
/// of effects that is studied last. Errors: a command that fails under valgrind.
[[nodiscard]] Result<void> count_instructions(const Family& family, const SearchPath& search,
                                              const DrawCommand& command, const std::string& machine,
                                              const Progress& progress, Journal& journal, Study& study);

}  // namespace gobo::study
