// Machines that GLSL allows: what is watched on one may not happen on another.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

enum class Machine {
    ieee,         ///< fp32, round to nearest
    flushed,      ///< denormal operands and results are 0
    nan_kept,     ///< min, max and clamp give a NaN wherever they are given one
    nan_dropped,  ///< min, max and clamp give a number wherever they are given one
    fused,        ///< a * b + c is rounded once
    regrouped,    ///< (a + b) + c is computed as a + (b + c), and what cancels is gone
    reordered,    ///< (a + b) + c is computed as (a + c) + b, and what cancels is gone
    errors_up,    ///< pow, exp, log, inversesqrt and their like too large by all that is allowed
    errors_down,  ///< too small by as much
};

inline constexpr Machine kMachines[] = {Machine::ieee,        Machine::flushed,   Machine::nan_kept,
                                        Machine::nan_dropped, Machine::fused,     Machine::regrouped,
                                        Machine::reordered,   Machine::errors_up, Machine::errors_down};

/// As the enumerators are called: "ieee", "flushed", ...
[[nodiscard]] constexpr std::string_view name_of(Machine machine) {
    constexpr std::string_view kNames[] = {"ieee",      "flushed",   "nan_kept",  "nan_dropped", "fused",
                                           "regrouped", "reordered", "errors_up", "errors_down"};
    return kNames[static_cast<std::size_t>(machine)];
}

[[nodiscard]] constexpr std::optional<Machine> machine_named(std::string_view name) {
    for (const Machine machine : kMachines)
        if (name_of(machine) == name) return machine;
    return std::nullopt;
}

[[nodiscard]] inline evaluate::Options options_of(Machine machine) {
    evaluate::Options options;
    options.flush_denormals = machine == Machine::flushed;
    if (machine == Machine::nan_kept) options.nans = evaluate::NaNs::kept;
    if (machine == Machine::nan_dropped) options.nans = evaluate::NaNs::dropped;
    if (machine == Machine::fused) options.sums = evaluate::Sums::fused;
    if (machine == Machine::regrouped) options.sums = evaluate::Sums::regrouped;
    if (machine == Machine::reordered) options.sums = evaluate::Sums::reordered;
    if (machine == Machine::errors_up) options.errors = evaluate::Errors::largest_up;
    if (machine == Machine::errors_down) options.errors = evaluate::Errors::largest_down;
    return options;
}

}  // namespace gobo::sanitize
