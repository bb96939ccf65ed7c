// NVIDIA's instructions as Mesa's NVK prints them, and what they cost: the driver counts them, and no more.
#pragma once

#include "lab/cost/stage_cost.hpp"

namespace gobo::cost {

struct NvidiaCode {
    ByKind kinds = {};
    bool has_loop = false;  ///< a block is followed by itself or an earlier one
    /// For one warp of 32, when as many run as fit: the busiest of what a quarter of a multiprocessor has:
    /// one instruction issued per cycle, and its units for arithmetic. Every instruction counts once, those
    /// of both sides of a branch too. Rates: CUDA C++ Programming Guide, throughput of native arithmetic
    /// instructions; attributes are interpolated by the units of transcendental functions (Lindholm et al.
    /// 2008, IEEE Micro 28/2).
    std::uint64_t cycles = 0;
    std::uint64_t latency = 0;            ///< the delays that the compiler wrote at each instruction
    std::uint64_t uniform_registers = 0;  ///< one value for the whole warp
};

[[nodiscard]] NvidiaCode read_nvidia_assembly(std::string_view text, std::string_view architecture);

/// Warps that fit on a quarter of a multiprocessor: 65536 registers, allotted by eights, and the most that
/// the architecture keeps (CUDA C++ Programming Guide, technical specifications).
[[nodiscard]] std::uint64_t nvidia_occupancy(std::uint64_t registers, std::string_view architecture);

}  // namespace gobo::cost
