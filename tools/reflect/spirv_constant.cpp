#include "reflect/spirv_constant.hpp"

#include <limits>

namespace gobo::spirv {
namespace {

std::optional<std::int64_t> value_of(std::uint32_t id, const std::map<std::uint32_t, std::int64_t>& known) {
    const auto found = known.find(id);
    if (found == known.end()) return std::nullopt;
    return found->second;
}

/// Values beyond 32 bits are of no use as sizes; refusing them keeps the arithmetic below from overflowing.
bool fits(std::int64_t value) {
    return value >= std::numeric_limits<std::int32_t>::min() &&
           value <= std::numeric_limits<std::uint32_t>::max();
}

std::optional<std::int64_t> combined(spv::Op operation, std::int64_t left, std::int64_t right) {
    switch (operation) {
        case spv::Op::OpIAdd:
            return left + right;
        case spv::Op::OpISub:
            return left - right;
        case spv::Op::OpIMul:
            return left * right;
        case spv::Op::OpSDiv:
        case spv::Op::OpUDiv:
            return right == 0 ? std::nullopt : std::optional(left / right);
        case spv::Op::OpSMod:
        case spv::Op::OpSRem:
        case spv::Op::OpUMod:
            return right == 0 ? std::nullopt : std::optional(left % right);
        default:
            return std::nullopt;
    }
}

}  // namespace

std::optional<std::int64_t> literal_integer(std::span<const std::uint32_t> literal, int width,
                                            bool is_signed) {
    if (literal.empty() || (width > 32 && literal.size() < 2)) return std::nullopt;
    if (width > 32) return static_cast<std::int64_t>((std::uint64_t{literal[1]} << 32) | literal[0]);
    return is_signed ? std::int64_t{static_cast<std::int32_t>(literal[0])} : std::int64_t{literal[0]};
}

std::optional<std::int64_t> folded_integer(spv::Op operation, std::span<const std::uint32_t> operands,
                                           const std::map<std::uint32_t, std::int64_t>& known) {
    if (operands.empty()) return std::nullopt;
    const std::optional<std::int64_t> left = value_of(operands[0], known);
    if (!left || !fits(*left)) return std::nullopt;
    if (operation == spv::Op::OpSNegate) return -*left;
    if (operands.size() < 2) return std::nullopt;
    const std::optional<std::int64_t> right = value_of(operands[1], known);
    if (!right || !fits(*right)) return std::nullopt;
    const std::optional<std::int64_t> result = combined(operation, *left, *right);
    return result && fits(*result) ? result : std::nullopt;
}

}  // namespace gobo::spirv
