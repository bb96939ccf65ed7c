// The clock that draws on a GPU are timed by, and whether it can be trusted: held to a load that is known.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/render/context.hpp"

namespace gobo::study {

/// The nanoseconds that a clock gave a load of so many equal parts.
struct LoadTime {
    double load = 0;
    double nanoseconds = 0;
};

/// How far the times are from growing in proportion to the load, whatever they begin at: the largest
/// deviation from the straight line that fits them best, relative to how much that line grows from the least
/// load to the greatest. 1 where they do not grow, and of fewer than three loads.
[[nodiscard]] double load_error(const std::vector<LoadTime>& times);

/// A clock that is off by more is not trusted: nothing is ranked by it.
inline constexpr double kLargestLoadError = 0.05;

/// Times one draw, in nanoseconds: what it is given draws and returns.
using DrawClock = std::function<double(const std::function<void()>& draw)>;

/// The renderer's own clock, GL_TIME_ELAPSED.
[[nodiscard]] DrawClock timer_query(const Context& context);
/// A monotonic clock around glFinish(): with it the processor's time to hand over the draw.
[[nodiscard]] DrawClock finished_draw(const Context& context);

/// Draws a load once, twice, three and four times over, the median of some rounds each: load_error() of what
/// the clock says. The load is as many layers of the same fragments as take a few milliseconds. Errors: of
/// the driver.
[[nodiscard]] Result<double> known_load_error(const Context& context, const DrawClock& clock);

struct ChosenClock {
    DrawClock clock;
    std::string name;  ///< "timer query"
    double error = 0;  ///< by the known load
    /// Whether anything may be ranked by it.
    [[nodiscard]] bool is_trusted() const { return error <= kLargestLoadError; }
};

/// The renderer's own clock where the known load bears it out, else a monotonic one; that may not be trusted
/// either. Errors: of the driver.
[[nodiscard]] Result<ChosenClock> choose_clock(const Context& context);

}  // namespace gobo::study
