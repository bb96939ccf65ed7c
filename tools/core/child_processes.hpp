// Work spread over child processes: where it crashes, hangs or takes too much memory, only the child dies.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// What a child process may take. 0 in the first two: as much as it wants.
struct ChildLimits {
    int processor_seconds = 10;                 ///< for one task
    std::size_t memory = std::size_t{2} << 30;  ///< bytes beside what its parent holds
    std::size_t stack = std::size_t{64} << 20;  ///< bytes, where the system allows so many
    int wall_seconds = 0;       ///< until its task ends or its note changes; 0: as long as it wants
    bool writes_files = false;  ///< whether it may
};

enum class Death {
    crash,
    time,
    memory,
    killed,  ///< from outside, as a system does that runs out of memory
    exit,    ///< the work itself ended the process, as if all were done
};

/// What a child is about, for the parent to read where it dies. 0 at first.
using Note = std::atomic<int>;

/// While a note is this, ChildLimits::wall_seconds do not count.
inline constexpr int kClockStands = -1;
/// Where a task ends with this note, its process ends too, and a new one does the next.
inline constexpr int kStartAnew = -2;

struct ChildWork {
    /// In a child: the result of a task, as bytes.
    std::function<std::string(std::size_t task, Note& note)> work;
    /// In the parent, in any order. False where the bytes are not what `work` returns.
    std::function<bool(std::size_t task, std::string_view bytes)> done;
    /// In the parent: the child died. A new one, which sees all that the parent knows by now, takes the task
    /// again if the answer is true.
    std::function<bool(std::size_t task, int note, Death death)> died;
};

/// Does each task below `count` once, by `jobs` child processes at a time. They begin as copies of this
/// process, so they need no input; a parent that dies leaves none behind. The tasks that were not done since
/// no process could be started.
[[nodiscard]] std::vector<std::size_t> run_in_children(int jobs, std::size_t count, const ChildWork& work,
                                                       const ChildLimits& limits = {});

/// In a child: writes all of it, or ends the process where that fails.
void write_or_exit(int file, std::string_view bytes);

}  // namespace gobo
