// The instructions that evaluation knows: adding one is adding a row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lab/evaluate/kinds.hpp"
#include "lab/evaluate/program.hpp"

namespace gobo::evaluate {

template <class T>
class Machine;
template <class T>
using Execute = void (*)(const Operation&, Machine<T>&);

/// How a row runs in either arithmetic.
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

/// How a row runs on machines that take the liberties GLSL allows; where a member is empty, as everywhere.
struct Liberties {
    Execution fused = {};        ///< products and their sum rounded once
    Execution backwards = {};    ///< sums from the last term to the first
    Execution nan_kept = {};     ///< the NaN among two operands is the result
    Execution nan_dropped = {};  ///< the other operand is
};

/// One instruction. `signature` is what it gives and takes, as "f:ff": f real, i integer, b boolean; lower
/// case for values of n components (any n, the same throughout; n as a last digit demands it), upper case for
/// scalars, * for anything of the result's type. Rows with an empty signature are placed by the decoder's own
/// functions. A code may have several rows: the first whose signature fits is taken.
struct Row {
    std::uint32_t code;  ///< spv::Op, or kExtended + the number in GLSL.std.450, or one of Internal
    std::string_view name;
    Kind kind;
    std::string_view signature;
    Execution execution;
    Liberties liberties = {};
};

inline constexpr std::uint32_t kExtended = 0x10000;

/// Operations that the decoder makes beside those of SPIR-V.
enum Internal : std::uint32_t {
    kKeep = 0x20000,  ///< copies the active lanes; bookkeeping without a name: neither counted nor observed
    kGather,          ///< a load through an address that each lane computes
    kScatter,         ///< a store through such an address
};

/// All rows.
[[nodiscard]] std::span<const Row> instruction_table();
/// The first row with this code; nothing where there is none.
[[nodiscard]] std::optional<std::uint32_t> find_row(std::uint32_t code);

// The parts of the table, one file each.
[[nodiscard]] std::span<const Row> arithmetic_rows();
[[nodiscard]] std::span<const Row> integer_rows();
[[nodiscard]] std::span<const Row> comparison_rows();
[[nodiscard]] std::span<const Row> conversion_rows();
[[nodiscard]] std::span<const Row> matrix_rows();
[[nodiscard]] std::span<const Row> memory_rows();
[[nodiscard]] std::span<const Row> elementary_rows();
[[nodiscard]] std::span<const Row> geometric_rows();
[[nodiscard]] std::span<const Row> packing_rows();
[[nodiscard]] std::span<const Row> quad_rows();
[[nodiscard]] std::span<const Row> image_rows();

}  // namespace gobo::evaluate
