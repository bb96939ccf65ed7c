// Machines that GLSL allows: what is watched on one may not happen on another.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "evaluate/evaluate.hpp"

namespace gobo::sanitize {

enum class Machine {
    ieee,         ///< fp32, round to nearest
    flushed,      ///< denormal operands and results are 0
    errors_up,    ///< pow, exp, log, inversesqrt and their like too large by all that is allowed
    errors_down,  ///< too small by as much
};

inline constexpr Machine kMachines[] = {Machine::ieee, Machine::flushed, Machine::errors_up,
                                        Machine::errors_down};

/// "ieee", "flushed", "errors_up", "errors_down".
[[nodiscard]] constexpr std::string_view name_of(Machine machine) {
    constexpr std::string_view kNames[] = {"ieee", "flushed", "errors_up", "errors_down"};
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
    if (machine == Machine::errors_up) options.errors = evaluate::Errors::largest_up;
    if (machine == Machine::errors_down) options.errors = evaluate::Errors::largest_down;
    return options;
}

}  // namespace gobo::sanitize
