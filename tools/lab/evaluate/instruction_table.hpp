// The instructions that evaluation knows: adding one is adding a row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lab/evaluate/program.hpp"

namespace gobo::evaluate {

template <class T>
class Registers;
template <class T>
using Execute = void (*)(const Operation&, Registers<T>&);

/// How a row runs in floats and in doubles.
struct Execution {
    Execute<float> in_float = nullptr;
    Execute<double> in_double = nullptr;

    template <class T>
    [[nodiscard]] Execute<T> in() const {
        if constexpr (sizeof(T) == 4)
            return in_float;
        else
            return in_double;
    }
};

/// How a row runs in arithmetics that take the liberties GLSL allows; where a member is empty, as everywhere.
struct Liberties {
    Execution fused = {};        ///< products and their sum rounded once
    Execution backwards = {};    ///< sums from the last term to the first
    Execution nan_kept = {};     ///< the NaN among two operands is the result
    Execution nan_dropped = {};  ///< the other operand is
    /// How far the result for the operands x and y may be off beyond its rounding; nullptr for not at all.
    double (*largest_error)(double x, double y, double result) = nullptr;
};

/// One instruction. `signature` is what it gives and takes, as "f:ff": f float of any width, d of 64 bits, h
/// of 16, i integer of up to 32 bits, l of 64, b boolean; lower case for values of n components (any n, the
/// same throughout; n as a last digit demands it), upper case for scalars, * for anything of the result's
/// type, m for a matrix of it, s for a structure of two values like the operand. Rows with an empty signature
/// are placed by the decoder's own functions. A code may have several rows: the first whose signature fits is
/// taken.
struct Row {
    std::uint32_t code;     ///< spv::Op, or kExtended + the number in GLSL.std.450, or one of Internal
    std::string_view name;  ///< "FMul", "Pow"; a load or store has that name through an address too
    Kind kind;
    std::string_view signature;
    Execution execution;
    Liberties liberties = {};
    bool is_bookkeeping = false;  ///< of the decoder: neither counted nor observed
};

inline constexpr std::uint32_t kExtended = 0x10000;

/// Operations that the decoder makes beside those of SPIR-V.
enum Internal : std::uint32_t {
    kCopy = 0x20000,  ///< copies the active lanes
    kGather,          ///< a load through an address that each lane computes
    kScatter,         ///< a store through such an address
};

/// All rows.
[[nodiscard]] std::span<const Row> instruction_table();
/// The first row with this code; nothing where there is none.
[[nodiscard]] std::optional<std::uint32_t> find_row(std::uint32_t code);
[[nodiscard]] inline const Row& row_of(const Operation& operation) {
    return instruction_table()[operation.row];
}

// The parts of the table, one file each.
extern const std::span<const Row> kFloatRows;
extern const std::span<const Row> kIntegerRows;
extern const std::span<const Row> kComparisonRows;
extern const std::span<const Row> kVectorRows;
extern const std::span<const Row> kMemoryRows;
extern const std::span<const Row> kImageRows;
extern const std::span<const Row> kWideRows;

}  // namespace gobo::evaluate
