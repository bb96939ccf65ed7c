// Variants of arithmetic that GLSL allows: what is watched on one may not happen on another.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::sanitize {

enum class Machine {
    ieee,             ///< fp32, round to nearest
    flushed,          ///< denormal operands and results are 0
    nan_kept,         ///< min, max and clamp give a NaN wherever they are given one
    nan_dropped,      ///< min, max and clamp give a number wherever they are given one
    fused,            ///< a * b + c is rounded once
    regrouped,        ///< (a + b) + c is computed as a + (b + c), and what cancels is gone
    reordered,        ///< (a + b) + c is computed as (a + c) + b, and what cancels is gone
    errors_up,        ///< divisions, roots, powers, exponentials, angles too large by all that is allowed
    errors_down,      ///< too small by as much
    mediump,          ///< what the shader says is mediump or lowp is a 16-bit float
    mediump_flushed,  ///< and denormal ones, below 2^-14, are 0
};

struct MachineRow {
    Machine machine;
    std::string_view name;
    evaluate::Options options;
};
inline constexpr MachineRow kMachineRows[] = {
    {Machine::ieee, "ieee", {}},
    {Machine::flushed, "flushed", {.flush_denormals = true}},
    {Machine::nan_kept, "nan_kept", {.nans = evaluate::NaNs::kept}},
    {Machine::nan_dropped, "nan_dropped", {.nans = evaluate::NaNs::dropped}},
    {Machine::fused, "fused", {.sums = evaluate::Sums::fused}},
    {Machine::regrouped, "regrouped", {.sums = evaluate::Sums::regrouped}},
    {Machine::reordered, "reordered", {.sums = evaluate::Sums::reordered}},
    {Machine::errors_up, "errors_up", {.errors = evaluate::Errors::largest_up}},
    {Machine::errors_down, "errors_down", {.errors = evaluate::Errors::largest_down}},
    {Machine::mediump, "mediump", {.is_half = true}},
    {Machine::mediump_flushed, "mediump_flushed", {.flush_denormals = true, .is_half = true}},
};

[[nodiscard]] constexpr std::string_view name_of(Machine machine) {
    return kMachineRows[static_cast<std::size_t>(machine)].name;
}

[[nodiscard]] constexpr evaluate::Options options_of(Machine machine) {
    return kMachineRows[static_cast<std::size_t>(machine)].options;
}

[[nodiscard]] constexpr std::optional<Machine> machine_named(std::string_view name) {
    for (const MachineRow& row : kMachineRows)
        if (row.name == name) return row.machine;
    return std::nullopt;
}

inline constexpr auto kMachines = [] {
    std::array<Machine, std::size(kMachineRows)> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = kMachineRows[i].machine;
    return all;
}();

}  // namespace gobo::sanitize
