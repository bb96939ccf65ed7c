// What a graphics driver is to do, in child processes: where it crashes or hangs, only what it was about is
// lost.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/bytes.hpp"
#include "core/child_processes.hpp"

namespace gobo {

/// So long may a driver take for a program, a pair of stages or a picture, or for one draw of a scene.
inline constexpr int kDriverSeconds = 60;

/// Measures the driver's own work within a task.
class DriverClock {
  public:
    explicit DriverClock(Note& note) : note_(note) {}
    /// From now on the driver works on this part of the task, from 0, and has kDriverSeconds for it.
    void begin(int part) { note_ = part; }
    /// What comes now is not the driver's work, and may take as long as it wants.
    void stop() { note_ = kClockStands; }
    /// What the driver is or was last told to work on.
    [[nodiscard]] int part() const { return std::max(note_.load(), 0); }

  private:
    Note& note_;
};

/// "crashed", "gave no answer within 60 s"
[[nodiscard]] std::string ending_of(Death death, int seconds = kDriverSeconds);
/// What to do about a driver that ends without having been asked anything.
[[nodiscard]] tl::unexpected<Diagnostics> fail_to_open(const std::string& driver, const std::string& ending);

/// In a child process: what a driver prints is not the command's output.
void send_output_to_errors();

/// Whether the errors of a task are the driver's own failure, after which nothing else can be asked of it.
[[nodiscard]] bool is_of_driver(const Diagnostics& errors);

/// Tasks for a driver, whose results are sent as bytes (core/bytes.hpp).
template <class Driver, class Value>
struct DriverTasks {
    std::string driver;  ///< in messages: "the renderer of --backend egl"
    std::size_t count = 0;
    int jobs = 1;                               ///< child processes at a time
    std::function<Result<Driver>()> open = {};  ///< once in each child process
    std::function<Result<Value>(Driver& driver, std::size_t task, DriverClock& clock)> work = {};
    /// In the calling process, in any order. Where the driver ended, `value` is an error (Fault::input) that
    /// says how, and `death` the part of the task that it was about. So it is where `work` has an error of
    /// Fault::file: other tasks have another process, and a driver that is opened anew.
    std::function<void(std::size_t task, Result<Value> value, std::optional<int> death)> done = {};
    int seconds = kDriverSeconds;
};

/// Does the tasks. Errors: those of opening; a driver that dies while it is opened (Fault::file). The calling
/// process must have no other threads.
template <class Driver, class Value>
[[nodiscard]] Result<void> ask_driver(const DriverTasks<Driver, Value>& tasks) {
    // Behind the part of the task that the driver failed at, or what else became of it.
    using Sent = std::pair<int, Result<Value>>;
    constexpr int kOpening = -3;
    constexpr int kWorked = -4;
    std::optional<Diagnostics> not_opened;
    const auto opened = std::make_shared<std::optional<Driver>>();  // each child has its own
    ChildWork child;
    child.work = [&](std::size_t task, Note& note) {
        const auto not_open = [](Diagnostics errors) {
            return to_bytes(Sent(int{kOpening}, tl::unexpected(std::move(errors))));
        };
        if (not_opened) return not_open(*not_opened);
        note = kOpening;
        if (!*opened) {
            send_output_to_errors();
            Result<Driver> driver = tasks.open();
            if (!driver) return not_open(std::move(driver).error());
            opened->emplace(*std::move(driver));
        }
        DriverClock clock(note);
        clock.begin(0);
        Sent sent(kWorked, tasks.work(**opened, task, clock));
        if (!sent.second && is_of_driver(sent.second.error())) {
            for (Diagnostic& error : sent.second.error()) error.fault = Fault::input;
            sent.first = clock.part();
            note = kStartAnew;
        }
        return to_bytes(sent);
    };
    child.done = [&](std::size_t task, std::string_view bytes) {
        std::optional<Sent> sent = from_bytes<Sent>(bytes);
        if (!sent) return false;
        if (sent->first == kOpening)
            not_opened = std::move(sent->second).error();
        else
            tasks.done(task, std::move(sent->second),
                       sent->first == kWorked ? std::nullopt : std::optional(sent->first));
        return true;
    };
    child.died = [&](std::size_t task, int note, Death death) {
        const std::string ending = ending_of(death, tasks.seconds);
        if (note == kOpening)
            not_opened = fail_to_open(tasks.driver, ending).value();
        else
            tasks.done(task, fail(Fault::input, tasks.driver + " " + ending), std::max(note, 0));
        return false;
    };
    const std::vector<std::size_t> left = run_in_children(
        tasks.jobs, tasks.count, child,
        {.processor_seconds = 0, .memory = 0, .wall_seconds = tasks.seconds, .writes_files = true});
    if (not_opened) return tl::unexpected(*std::move(not_opened));
    if (!left.empty()) return fail(Fault::internal, "no process can be started for " + tasks.driver);
    return {};
}

}  // namespace gobo
