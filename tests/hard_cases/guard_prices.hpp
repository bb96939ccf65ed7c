// What each guard costs: operations, counted by the evaluator, and time, measured on a renderer.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "lab/evaluate/program.hpp"
#include "lab/render/context.hpp"
#include "lit_guards.hpp"

namespace gobo {

/// The operations of one invocation of the stage that a guard is in, with the guard and without it.
struct GuardOperations {
    std::string key;  ///< the permutation: of those that the guard's case concerns the first with its piece
    evaluate::Counts guarded{};
    evaluate::Counts plain{};
};

/// Counted at an ordinary point, where both formulas hold.
[[nodiscard]] GuardOperations operations_of(const Guard& guard);

/// How many operations that compute something: no loads, stores, moves and calls, which compilers remove.
[[nodiscard]] std::uint64_t computing(const evaluate::Counts& counts);

/// "+2: 1 compare, 1 branch"; "none" where nothing is added.
[[nodiscard]] std::string added_text(const GuardOperations& operations);

/// Cycles of 64 invocations of the stage that a guard is in, as a chip's compiler estimates them.
struct GuardCycles {
    std::string gpu;     ///< "navi21"
    std::string driver;  ///< "radv Mesa 25.0.7"
    std::uint64_t guarded = 0;
    std::uint64_t plain = 0;
};

/// The chips that guards are costed on.
inline constexpr std::array<const char*, 3> kGuardChips = {"navi21", "gfx1201", "ampere"};

/// By the guard's name; with the drivers that were unpacked into a folder (gobo cost --driver), by a
/// gobo-lab.
[[nodiscard]] Result<std::map<std::string, std::vector<GuardCycles>>> measure_cycles(
    const std::string& folder, const std::string& lab);

/// Processor times of drawing 256 x 256 fragments, over interleaved rounds.
struct GuardTime {
    struct Quartiles {
        double low = 0;  ///< microseconds
        double median = 0;
        double high = 0;
    };
    Quartiles guarded;
    Quartiles plain;
    std::string renderer;
    std::vector<GuardCycles> cycles = {};  ///< on chips, by kGuardChips

    /// The quartiles do not overlap.
    [[nodiscard]] bool is_measurable() const;
};

/// All zero for guards of the vertex stage: shading a few vertices takes no time that could be told. Without
/// cycles.
[[nodiscard]] GuardTime measure(const Guard& guard, const Context& context);

/// By the guard's name.
using GuardTimes = std::map<std::string, GuardTime, std::less<>>;

/// docs/data/guard_prices.csv: a line for each guard, with its operations and times.
[[nodiscard]] std::string to_csv(const GuardTimes& times);
/// The times of such a file.
[[nodiscard]] GuardTimes times_of_csv(const std::string& csv);

}  // namespace gobo
