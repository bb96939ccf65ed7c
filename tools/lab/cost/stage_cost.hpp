// What a compiled stage costs, from the driver's statistics and its assembly.
#pragma once

#include <array>
#include <string_view>

#include "lab/cost/chips.hpp"
#include "lab/cost/driver.hpp"

namespace gobo::cost {

/// What instructions do.
enum class Kind : std::uint8_t {
    arithmetic,      ///< on each invocation: add, multiply, compare, convert, choose
    transcendental,  ///< reciprocals, square roots, exp, log, sin, cos: at a quarter of the rate
    interpolation,   ///< of varyings
    move,
    scalar,  ///< once for all invocations of a wave
    memory,  ///< loads and stores of buffers
    texture,
    branch,
    output,  ///< colours, positions and varyings
    wait,    ///< for memory, and hints of scheduling
};
inline constexpr std::array<std::string_view, 10> kKindNames = {
    "arithmetic", "transcendental", "interpolation", "move",   "scalar",
    "memory",     "texture",        "branch",        "output", "wait"};
using ByKind = std::array<std::uint64_t, kKindNames.size()>;

/// A compiler's static estimate for one stage of a pipeline.
struct StageCost {
    std::string stage;  ///< "vertex" or "fragment"
    std::uint64_t instructions = 0;
    std::uint64_t vector_registers = 0;
    std::uint64_t scalar_registers = 0;
    std::uint64_t occupancy = 0;  ///< waves that fit on a SIMD
    /// For 64 vertices or fragments, with as many waves as fit: AMD's driver's inverse throughput; of
    /// NVIDIA's chips gobo's own estimate, nvidia_assembly.hpp.
    std::uint64_t cycles = 0;
    std::uint64_t latency = 0;  ///< cycles of one wave alone; of NVIDIA's without waiting for memory
    std::uint64_t code_bytes = 0;
    std::uint64_t spills = 0;  ///< registers kept in memory
    /// Cycles and latency hang on a guess of the compiler's: a loop was left in the code, or one whose turns
    /// the source leaves open was unrolled.
    bool has_loop = false;
    ByKind kinds = {};
    std::string assembly;

    friend bool operator==(const StageCost&, const StageCost&) = default;
};

/// `loop_varies`: as Pipeline has it of the stage.
[[nodiscard]] StageCost cost_of(CompiledStage compiled, const Chip& chip, bool loop_varies);

/// Instructions of AMD's assembly by kind.
[[nodiscard]] ByKind count_kinds(std::string_view assembly);
/// Whether AMD's assembly branches to a label that stands before the branch.
[[nodiscard]] bool branches_back(std::string_view assembly);

}  // namespace gobo::cost
