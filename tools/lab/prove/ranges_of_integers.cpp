// What operations on integers, and conversions to them, make of what is known of their operands.
#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

/// 2^k - 1 at least as large.
double all_bits(double number) {
    double bits = 0;
    while (bits < number) bits = 2 * bits + 1;
    return bits;
}

Range wrapped(const Range& range) {
    if (range.low < kAnyInt.low || range.high > kAnyInt.high) return kAnyInt;
    Range whole = range;
    whole.grid = 0;
    whole.nan = false;
    return tidy(whole);
}

}  // namespace

Range Ranges::evaluate_whole(const Expression& expression, const std::uint32_t* operands) const {
    std::array<Range, 4> r{};
    for (std::uint32_t at = 0; at < expression.count; ++at) {
        const Range& range = known_[operands[at]].range;
        if (range.is_empty()) return kNothing;
        if (at >= r.size()) continue;
        r[at] = range;
        if (expressions_.all[operands[at]].scalar == Scalar::float32) continue;
        r[at].nan = false;
        r[at] = both(r[at], kAnyInt);
    }
    const bool is_truth = expression.scalar == Scalar::boolean;
    const bool are_positive = r[0].low >= 0 && (expression.count < 2 || r[1].low >= 0);
    const auto truth = [](bool may_be_true, bool may_be_false) {
        return may_be_true && may_be_false ? kTruth : exactly(may_be_true ? 1 : 0);
    };
    switch (expression.code) {
        case spv::OpLogicalAnd:
            return truth(r[0].high > 0 && r[1].high > 0, r[0].low == 0 || r[1].low == 0);
        case spv::OpLogicalOr:
            return truth(r[0].high > 0 || r[1].high > 0, r[0].low == 0 && r[1].low == 0);
        case spv::OpLogicalNot:
            return truth(r[0].low == 0, r[0].high > 0);
        case spv::OpIsNan:
            return truth(r[0].nan, !r[0].has_no_number());
        case spv::OpIsInf:
            return truth(is_infinite(r[0]), true);
        case spv::OpIAdd:
            return wrapped(sum(r[0], r[1]));
        case spv::OpISub:
            return wrapped(sum(r[0], negated(r[1])));
        case spv::OpIMul:
            return wrapped(product(r[0], r[1]));
        case spv::OpSNegate:
            return wrapped(negated(r[0]));
        case extended(GLSLstd450SAbs):
            return wrapped(size_of(r[0]));
        case extended(GLSLstd450SSign):
            return tidy({r[0].low < 0   ? -1.0
                         : r[0].low > 0 ? 1.0
                                        : 0.0,
                         r[0].high > 0   ? 1.0
                         : r[0].high < 0 ? -1.0
                                         : 0.0,
                         1, 0, true, false});
        case spv::OpUDiv:
            if (!are_positive && r[1].low >= 2) return whole_between(0, std::floor(kAnyUint.high / r[1].low));
            if (!are_positive || r[1].holds_zero()) return kAnyInt;
            [[fallthrough]];
        case spv::OpSDiv: {
            if (r[1].holds_zero() || r[1].low < 0) return wrapped(within(-r[0].size(), r[0].size()));
            Range result = quotient(r[0], r[1]);
            return wrapped(tidy({std::trunc(result.low), std::trunc(result.high), 1, 0, true, false}));
        }
        case spv::OpUMod:
            if (!are_positive && r[1].low > 0) return whole_between(0, r[1].high - 1);
            if (!are_positive || r[1].holds_zero()) return kAnyInt;
            [[fallthrough]];
        case spv::OpSRem:
        case spv::OpSMod: {
            if (r[0].is_one() && r[1].is_one() && r[0].low >= 0 && r[1].low > 0)
                return exactly(std::fmod(r[0].low, r[1].low));
            const double most = std::max(0.0, r[1].size() - 1);
            if (expression.code == spv::OpSMod)
                return wrapped(whole_between(r[1].low < 0 ? -most : 0, r[1].high > 0 ? most : 0));
            return wrapped(
                whole_between(r[0].low < 0 ? -most : 0, r[0].high > 0 ? std::min(most, r[0].high) : 0));
        }
        case spv::OpBitwiseAnd:
            if (r[0].is_one() && r[1].is_one())
                return exactly(static_cast<std::int32_t>(static_cast<std::int64_t>(r[0].low) &
                                                         static_cast<std::int64_t>(r[1].low)));
            if (r[0].low >= 0 && r[1].low >= 0) return whole_between(0, std::min(r[0].high, r[1].high));
            if (r[0].low >= 0) return whole_between(0, r[0].high);
            if (r[1].low >= 0) return whole_between(0, r[1].high);
            return kAnyInt;
        case spv::OpBitwiseOr:
        case spv::OpBitwiseXor: {
            const auto a = static_cast<std::int64_t>(r[0].low);
            const auto b = static_cast<std::int64_t>(r[1].low);
            if (r[0].is_one() && r[1].is_one())
                return exactly(static_cast<double>(expression.code == spv::OpBitwiseOr ? a | b : a ^ b));
            return are_positive ? whole_between(0, all_bits(std::max(r[0].high, r[1].high))) : kAnyInt;
        }
        case spv::OpNot:
            return wrapped(sum(negated(r[0]), exactly(-1)));
        case spv::OpShiftRightLogical:
            if (r[0].low < 0 && r[1].is_one() && r[1].low >= 1 && r[1].low <= 31)
                return whole_between(0, std::ldexp(1.0, 32 - static_cast<int>(r[1].low)) - 1);
            if (r[0].low < 0) return kAnyInt;
            [[fallthrough]];
        case spv::OpShiftRightArithmetic:
            if (!r[1].is_one() || r[1].low < 0 || r[1].low > 31)
                return r[0].low >= 0 ? whole_between(0, r[0].high) : kAnyInt;
            return tidy({std::floor(std::ldexp(r[0].low, -static_cast<int>(r[1].low))),
                         std::floor(std::ldexp(r[0].high, -static_cast<int>(r[1].low))), 1, 0, true, false});
        case spv::OpShiftLeftLogical:
            if (!r[1].is_one() || r[1].low < 0 || r[1].low > 31) return kAnyInt;
            return wrapped(tidy({std::ldexp(r[0].low, static_cast<int>(r[1].low)),
                                 std::ldexp(r[0].high, static_cast<int>(r[1].low)), 1, 0, true, false}));
        case spv::OpBitCount:
            return whole_between(0, 32);
        case extended(GLSLstd450FindILsb):
        case extended(GLSLstd450FindSMsb):
        case extended(GLSLstd450FindUMsb):
            return whole_between(-1, 31);
        case extended(GLSLstd450UMin):
        case extended(GLSLstd450SMin):
            if (expression.code == extended(GLSLstd450UMin) && !are_positive) {
                if (r[0].low < 0 && r[1].low < 0) return kAnyInt;
                return whole_between(0, r[0].low >= 0 ? r[0].high : r[1].high);
            }
            return smaller(r[0], r[1]);
        case extended(GLSLstd450UMax):
        case extended(GLSLstd450SMax):
            if (expression.code == extended(GLSLstd450UMax) && !are_positive) return kAnyInt;
            return larger(r[0], r[1]);
        case extended(GLSLstd450UClamp):
        case extended(GLSLstd450SClamp):
            if (expression.code == extended(GLSLstd450UClamp) && (!are_positive || r[2].low < 0))
                return kAnyInt;
            return smaller(larger(r[0], r[1]), r[2]);
        case spv::OpConvertFToS: {
            if (r[0].has_no_number()) return exactly(0);
            Range result{std::clamp(std::trunc(r[0].low), kAnyInt.low, kAnyInt.high),
                         std::clamp(std::trunc(r[0].high), kAnyInt.low, kAnyInt.high),
                         1,
                         0,
                         true,
                         false};
            return r[0].nan ? hull(tidy(result), exactly(0)) : tidy(result);
        }
        case spv::OpConvertFToU:
            if (r[0].nan || r[0].high > kAnyInt.high) return kAnyInt;
            return whole_between(std::max(0.0, std::trunc(r[0].low)), std::max(0.0, std::trunc(r[0].high)));
        case spv::OpBitcast:
        case spv::OpUConvert:
        case spv::OpSConvert:
        case spv::OpCopyObject:
            return expressions_.all[operands[0]].scalar == Scalar::float32 ? kAnyInt : r[0];
        default:
            return is_truth ? kTruth : kAnyInt;
    }
}

}  // namespace gobo::prove
