// Integer constants of a SPIR-V module, as array sizes need them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include <spirv/unified1/spirv.hpp11>

namespace gobo::spirv {

/// The value of OpConstant's or OpSpecConstant's literal for an integer of `width` bits; nothing where words
/// are missing.
[[nodiscard]] std::optional<std::int64_t> literal_integer(std::span<const std::uint32_t> literal, int width,
                                                          bool is_signed);

/// The value of an OpSpecConstantOp over known integers: sums, differences, products, quotients, remainders,
/// negation. Nothing for other operations, unknown operands, division by zero and results beyond 32 bits.
[[nodiscard]] std::optional<std::int64_t> folded_integer(spv::Op operation,
                                                         std::span<const std::uint32_t> operands,
                                                         const std::map<std::uint32_t, std::int64_t>& known);

}  // namespace gobo::spirv
