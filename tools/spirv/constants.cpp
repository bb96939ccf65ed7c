#include "spirv/constants.hpp"

#include <algorithm>
#include <utility>

namespace gobo::spirv {
namespace {

/// Ends what a malformed module makes go round in circles.
constexpr int kMostSteps = 512;

std::uint64_t low_bits(std::uint64_t bits, int width) {
    return width < 64 ? bits & ((std::uint64_t{1} << width) - 1) : bits;
}

std::int64_t with_sign(std::uint64_t bits, int width) {
    const int above = 64 - width;
    return static_cast<std::int64_t>(bits << above) >> above;
}

/// One component of what an operation makes of those of its operands, whose width is given. What stands above
/// the width of the result is cut off later.
std::optional<std::uint64_t> combined(spv::Op operation, std::uint64_t a, std::uint64_t b, int width) {
    const std::int64_t left = with_sign(a, width);
    const std::int64_t right = with_sign(b, width);
    const auto bits = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
    const bool shifts_all = b >= static_cast<std::uint64_t>(width);
    switch (operation) {
        case spv::OpUConvert:
        case spv::OpBitcast:
            return a;
        case spv::OpSConvert:
            return bits(left);
        case spv::OpSNegate:
            return 0 - a;
        case spv::OpNot:
            return ~a;
        case spv::OpLogicalNot:
            return a ^ 1U;
        case spv::OpIAdd:
            return a + b;
        case spv::OpISub:
            return a - b;
        case spv::OpIMul:
            return a * b;
        case spv::OpUDiv:
            return b == 0 ? std::nullopt : std::optional(a / b);
        case spv::OpUMod:
            return b == 0 ? std::nullopt : std::optional(a % b);
        case spv::OpSDiv:  // by -1 apart: the least number has no positive one
            if (b == 0) return std::nullopt;
            return right == -1 ? 0 - a : bits(left / right);
        case spv::OpSRem:
            if (b == 0) return std::nullopt;
            return right == -1 ? 0 : bits(left % right);
        case spv::OpSMod: {  // has the sign of the divisor
            if (b == 0) return std::nullopt;
            const std::int64_t rest = right == -1 ? 0 : left % right;
            return bits(rest != 0 && (rest < 0) != (right < 0) ? rest + right : rest);
        }
        case spv::OpShiftLeftLogical:
            return shifts_all ? std::nullopt : std::optional(a << b);
        case spv::OpShiftRightLogical:
            return shifts_all ? std::nullopt : std::optional(a >> b);
        case spv::OpShiftRightArithmetic:
            return shifts_all ? std::nullopt : std::optional(bits(left >> b));
        case spv::OpBitwiseOr:
        case spv::OpLogicalOr:
            return a | b;
        case spv::OpBitwiseAnd:
        case spv::OpLogicalAnd:
            return a & b;
        case spv::OpBitwiseXor:
            return a ^ b;
        case spv::OpIEqual:
        case spv::OpLogicalEqual:
            return a == b;
        case spv::OpINotEqual:
        case spv::OpLogicalNotEqual:
            return a != b;
        case spv::OpUGreaterThan:
            return a > b;
        case spv::OpUGreaterThanEqual:
            return a >= b;
        case spv::OpULessThan:
            return a < b;
        case spv::OpULessThanEqual:
            return a <= b;
        case spv::OpSGreaterThan:
            return left > right;
        case spv::OpSGreaterThanEqual:
            return left >= right;
        case spv::OpSLessThan:
            return left < right;
        case spv::OpSLessThanEqual:
            return left <= right;
        default:
            return std::nullopt;
    }
}

}  // namespace

void Constants::add(const Instruction& instruction) {
    std::optional<Constant> value = value_of(instruction);
    const std::optional<Constant> shape = zero(instruction.type);
    if (!value || !shape || value->count != shape->count) return;
    value->width = shape->width;
    for (std::uint64_t& bits : value->bits) bits = low_bits(bits, value->width);
    values_.emplace(instruction.result, *value);
}

std::optional<Constant> Constants::value(Id id) const {
    const auto found = values_.find(id);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::int64_t> Constants::integer(const Instruction& constant) const {
    const std::optional<Constant> found = value(constant.result);
    const Type& type = module_.type(constant.type);
    if (!found || type.opcode != spv::OpTypeInt) return std::nullopt;
    using enum Scalar;
    for (const Scalar has_sign : {int8, int16, int32, int64})
        if (type.value.scalar == has_sign) return with_sign(found->bits[0], found->width);
    if (found->bits[0] >> 63U != 0) return std::nullopt;
    return static_cast<std::int64_t>(found->bits[0]);
}

std::optional<Constant> Constants::zero(Id id) const {
    const Type& type = module_.type(id);
    Constant result;
    if (type.opcode == spv::OpTypeVector) {
        result = zero(type.element).value_or(Constant{.count = 0});
        if (result.count == 0) return std::nullopt;
        result.count = type.count;
        return result;
    }
    if (type.opcode != spv::OpTypeInt && type.opcode != spv::OpTypeBool) return std::nullopt;
    result.width = type.opcode == spv::OpTypeBool ? 1 : type.value.scalar_size() * 8;
    return result;
}

std::optional<Constant> Constants::value_of(const Instruction& instruction) const {
    switch (instruction.opcode) {
        case spv::OpConstantTrue:
        case spv::OpConstantFalse:
            return Constant{.bits = {instruction.opcode == spv::OpConstantTrue}};
        case spv::OpSpecConstantTrue:
        case spv::OpSpecConstantFalse:
        case spv::OpConstant:
        case spv::OpSpecConstant: {
            const auto id = module_.decoration(instruction.result, spv::DecorationSpecId);
            if (const auto own = id ? chosen_.find(*id) : chosen_.end(); own != chosen_.end())
                return Constant{.bits = {own->second}};
            if (instruction.opcode == spv::OpSpecConstantTrue) return Constant{.bits = {1}};
            if (instruction.opcode == spv::OpSpecConstantFalse) return Constant{};
            return Constant{.bits = {std::uint64_t{instruction.word(4)} << 32U | instruction.word(3)}};
        }
        case spv::OpConstantNull:
            return zero(instruction.type);
        case spv::OpConstantComposite:
        case spv::OpSpecConstantComposite:
            return composed(instruction, 3);
        case spv::OpSpecConstantOp:
            return computed(instruction);
        default:
            return std::nullopt;
    }
}

/// A vector of scalars and vectors.
std::optional<Constant> Constants::composed(const Instruction& instruction, std::size_t first) const {
    Constant result{.count = 0};
    for (std::size_t word = first; word < instruction.words.size(); ++word) {
        const std::optional<Constant> some = value(instruction.id(word));
        if (!some || result.count + some->count > result.bits.size()) return std::nullopt;
        std::copy_n(some->bits.begin(), some->count, result.bits.begin() + result.count);
        result.count += some->count;
    }
    return result;
}

std::optional<Constant> Constants::shuffled(const Instruction& instruction) const {
    const std::optional<Constant> first = value(instruction.id(4));
    const std::optional<Constant> second = value(instruction.id(5));
    const std::size_t count = instruction.words.size() - 6;
    if (!first || !second || count > first->bits.size()) return std::nullopt;
    Constant result{.count = static_cast<std::uint32_t>(count)};
    for (std::uint32_t i = 0; i < result.count; ++i) {
        const std::uint32_t index = instruction.word(6 + i);
        if (index >= first->count + second->count) return std::nullopt;
        result.bits[i] = index < first->count ? first->bits[index] : second->bits[index - first->count];
    }
    return result;
}

/// What a path of indices leads to within a constant: in structs and arrays by how they were put together.
std::optional<Constant> Constants::part(Id whole, std::vector<std::uint32_t> path) const {
    for (int step = 0; step < kMostSteps; ++step) {
        if (const std::optional<Constant> found = value(whole)) {
            if (path.empty()) return found;
            if (path.size() > 1 || path[0] >= found->count) return std::nullopt;
            return Constant{.bits = {found->bits[path[0]]}};
        }
        const Instruction* const made = module_.definition(whole);
        if (made == nullptr || path.empty()) return std::nullopt;
        const bool is_composite =
            made->opcode == spv::OpConstantComposite || made->opcode == spv::OpSpecConstantComposite;
        if (is_composite && path[0] < made->words.size() - 3) {
            whole = made->id(3 + path[0]);
            path.erase(path.begin());
        } else if (made->opcode == spv::OpSpecConstantOp && made->word(3) == spv::OpCompositeExtract) {
            path.insert(path.begin(), made->words.begin() + 5, made->words.end());
            whole = made->id(4);
        } else {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

std::optional<Constant> Constants::computed(const Instruction& instruction) const {
    const auto operation = instruction.as<spv::Op>(3);
    const auto rest = [&](std::size_t from) {
        return std::vector(
            instruction.words.begin() + static_cast<std::ptrdiff_t>(std::min(from, instruction.words.size())),
            instruction.words.end());
    };
    if (operation == spv::OpCompositeExtract) return part(instruction.id(4), rest(5));
    if (operation == spv::OpVectorShuffle && instruction.words.size() > 6) return shuffled(instruction);
    std::optional<Constant> a = value(instruction.id(4));
    std::optional<Constant> b = value(instruction.id(5));
    if (operation == spv::OpCompositeInsert) {
        const std::uint32_t index = instruction.word(6);
        if (!a || !b || a->count != 1 || index >= b->count || instruction.words.size() != 7)
            return std::nullopt;
        b->bits[index] = a->bits[0];
        return b;
    }
    if (operation == spv::OpSelect) {
        const std::optional<Constant> otherwise = value(instruction.id(6));
        if (!a || !b || !otherwise || b->count != otherwise->count) return std::nullopt;
        if (a->count != 1 && a->count != b->count) return std::nullopt;
        for (std::uint32_t i = 0; i < b->count; ++i)
            if (a->bits[a->count == 1 ? 0 : i] == 0) b->bits[i] = otherwise->bits[i];
        return b;
    }
    if (instruction.words.size() == 5) b = a;  // an operation of one operand
    if (!a || !b || a->count != b->count) return std::nullopt;
    for (std::uint32_t i = 0; i < a->count; ++i) {
        const std::optional<std::uint64_t> bits = combined(operation, a->bits[i], b->bits[i], a->width);
        if (!bits) return std::nullopt;
        a->bits[i] = *bits;
    }
    return a;
}

}  // namespace gobo::spirv
