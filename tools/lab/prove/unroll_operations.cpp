#include "lab/prove/unroll_operations.hpp"

#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/input_range.hpp"

namespace gobo::prove {
namespace {

using evaluate::Operation;
using evaluate::OperationInfo;
using evaluate::Slice;
using Id = ExpressionBuilder::Id;

/// The components of an operand.
std::vector<Id> part(const OperationInfo& info, const std::vector<Id>& all, std::size_t operand) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < operand; ++i) first += info.operands[i].count;
    return {all.begin() + static_cast<std::ptrdiff_t>(first),
            all.begin() + static_cast<std::ptrdiff_t>(first + info.operands[operand].count)};
}

std::vector<std::uint32_t> counting(std::size_t count, std::uint32_t step) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<std::uint32_t>(i) * step);
    return numbers;
}

Id slot_at(const Slots& slots, std::uint32_t slot) {
    return slot < slots.size() ? slots[slot] : 0;
}

}  // namespace

std::vector<OperationUnroller::Id> OperationUnroller::results_of(const Operation& operation,
                                                                 const OperationInfo& info,
                                                                 const evaluate::Row& row,
                                                                 const std::vector<Id>& operands,
                                                                 Slots& slots) {
    const std::uint32_t* words = program_.words.data() + operation.extra;
    std::vector<Id> results;
    const auto whole = [&](std::uint32_t code, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i)
            results.push_back(builder_.make(
                {.code = code, .part = i, .scalar = info.result.scalar, .is_precise = info.is_precise},
                operands));
    };
    switch (row.code) {
        case evaluate::kCopy:
        case spv::OpLoad:
        case spv::OpStore:
        case spv::OpCopyObject:
        case spv::OpCompositeExtract:
            results.assign(slots.begin() + operation.operands[0],
                           slots.begin() + operation.operands[0] + operation.count);
            return results;
        case spv::OpCompositeConstruct:
            for (std::uint32_t word = 0; word < operation.extras; word += 2)
                for (std::uint32_t i = 0; i < words[word + 1]; ++i) results.push_back(slots[words[word] + i]);
            return results;
        case spv::OpVectorShuffle:
            for (std::uint32_t i = 0; i < operation.count; ++i) results.push_back(slots[words[i]]);
            return results;
        case spv::OpCompositeInsert: {
            results.assign(slots.begin() + operation.operands[1],
                           slots.begin() + operation.operands[1] + operation.count);
            for (std::uint32_t i = 0; i < words[1]; ++i)
                results[words[0] + i] = slots[operation.operands[0] + i];
            return results;
        }
        case spv::OpAccessChain: {
            Id offset = words[0] == 0 ? builder_.constant(0, Scalar::int32) : slots[words[0] - 1];
            std::vector<std::uint32_t> all =
                words[0] == 0 ? std::vector<std::uint32_t>{0} : possible_offsets(offset);
            for (std::uint32_t word = 1; word < operation.extras; word += 3) {
                const Id index = clamped_index(slots[words[word]], words[word + 1]);
                const Id step = builder_.make({.code = spv::OpIMul, .scalar = Scalar::int32},
                                              {index, builder_.constant(words[word + 2], Scalar::int32)});
                offset = builder_.make({.code = spv::OpIAdd, .scalar = Scalar::int32}, {offset, step});
                std::vector<std::uint32_t> further;
                for (const std::uint32_t start : all)
                    for (std::uint32_t i = 0; i < words[word + 1]; ++i)
                        further.push_back(start + i * words[word + 2]);
                all = std::move(further);
            }
            offsets_[offset] = std::move(all);
            return {offset};
        }
        case evaluate::kGather:
            return gather(operation, slots);
        case evaluate::kScatter:
            return scatter(operation, slots);
        case spv::OpVectorExtractDynamic: {
            std::vector<Id> all = part(info, operands, 0);
            const Id index = clamped_index(part(info, operands, 1)[0], all.size());
            return {builder_.indexed(index, all, counting(all.size(), 1))};
        }
        case spv::OpVectorInsertDynamic: {
            const std::vector<Id> all = part(info, operands, 0);
            const Id index = clamped_index(part(info, operands, 2)[0], all.size());
            for (std::uint32_t i = 0; i < all.size(); ++i)
                results.push_back(builder_.replaced(index, i, part(info, operands, 1)[0], all[i]));
            return results;
        }
        case spv::OpSelect: {
            const std::vector<Id> conditions = part(info, operands, 0);
            const std::vector<Id> yes = part(info, operands, 1);
            const std::vector<Id> no = part(info, operands, 2);
            for (std::size_t i = 0; i < yes.size(); ++i)
                results.push_back(
                    builder_.selected(conditions[conditions.size() == 1 ? 0 : i], yes[i], no[i]));
            return results;
        }
        case spv::OpAny:
        case spv::OpAll: {
            Id all = operands[0];
            for (std::size_t i = 1; i < operands.size(); ++i)
                all = builder_.make({.code = row.code == spv::OpAny ? spv::OpLogicalOr : spv::OpLogicalAnd,
                                     .scalar = Scalar::boolean},
                                    {all, operands[i]});
            return {all};
        }
        case spv::OpDot:
            return {builder_.make({.code = kSumOfProducts, .is_precise = info.is_precise}, operands)};
        case spv::OpMatrixTimesVector:
        case spv::OpVectorTimesMatrix:
        case spv::OpMatrixTimesMatrix:
        case spv::OpOuterProduct:
            for (std::uint32_t column = 0; column < words[0]; ++column)
                for (std::uint32_t line = 0; line < words[1]; ++line) {
                    std::vector<Id> factors;
                    for (std::uint32_t term = 0; term < words[2]; ++term)
                        factors.push_back(slots[operation.operands[0] + line + term * words[1]]);
                    for (std::uint32_t term = 0; term < words[2]; ++term)
                        factors.push_back(slots[operation.operands[1] + column * words[2] + term]);
                    results.push_back(builder_.make({.code = kSumOfProducts}, factors));
                }
            return results;
        case spv::OpTranspose:
            for (std::uint32_t column = 0; column < words[0]; ++column)
                for (std::uint32_t line = 0; line < words[1]; ++line)
                    results.push_back(operands[line * words[0] + column]);
            return results;
        case extended(GLSLstd450Length):
        case extended(GLSLstd450Distance):
        case extended(GLSLstd450Determinant):
            return {builder_.make({.code = row.code}, operands)};
        case extended(GLSLstd450Normalize):
        case extended(GLSLstd450Cross):
        case extended(GLSLstd450Reflect):
        case extended(GLSLstd450Refract):
        case extended(GLSLstd450FaceForward):
        case extended(GLSLstd450MatrixInverse):
            whole(row.code, operation.count);
            return results;
        case extended(GLSLstd450ModfStruct):
        case extended(GLSLstd450FrexpStruct):
        case spv::OpIAddCarry:
        case spv::OpISubBorrow:
        case spv::OpUMulExtended:
        case spv::OpSMulExtended:
            for (std::uint32_t half = 0; half < 2; ++half)
                for (std::uint32_t i = 0; i < operation.count; ++i)
                    results.push_back(builder_.make(
                        {.code = row.code,
                         .part = half,
                         .scalar = row.code == extended(GLSLstd450ModfStruct) ||
                                           (row.code == extended(GLSLstd450FrexpStruct) && half == 0)
                                       ? Scalar::float32
                                       : Scalar::int32},
                        {operands[i],
                         operands[operands.size() > operation.count ? operation.count + i : i]}));
            return results;
        case extended(GLSLstd450PackSnorm4x8):
        case extended(GLSLstd450PackUnorm4x8):
        case extended(GLSLstd450PackSnorm2x16):
        case extended(GLSLstd450PackUnorm2x16):
        case extended(GLSLstd450PackHalf2x16):
            return {builder_.make({.code = row.code, .scalar = info.result.scalar}, operands)};
        default:
            break;
    }
    if (row.kind == evaluate::Kind::image) return texels(operation, info, row, slots);
    // Component by component; an operand of one component goes with all.
    const std::uint32_t count = std::max(info.result.count, 1U);
    for (std::uint32_t i = 0; i < count; ++i) {
        std::vector<Id> own;
        std::size_t first = 0;
        for (const Slice& operand : info.operands) {
            own.push_back(operands[first + (operand.count == 1 ? 0 : std::min(i, operand.count - 1))]);
            first += operand.count;
        }
        results.push_back(builder_.make({.code = row.code,
                                         .part = row.signature.empty() ? i : 0,
                                         .scalar = info.result.scalar,
                                         .is_precise = info.is_precise},
                                        std::move(own)));
    }
    return results;
}

std::vector<OperationUnroller::Id> OperationUnroller::texels(const Operation& operation,
                                                             const OperationInfo& info,
                                                             const evaluate::Row& row, const Slots& slots) {
    const evaluate::ImageCall call = evaluate::image_call_of(program_, operation);
    std::vector<Id> results;
    for (std::uint32_t i = 0; i < operation.count; ++i) {
        Range known = texel(call, slots, i);
        if (row.code == spv::OpImageQuerySizeLod || row.code == spv::OpImageQuerySize)
            known = whole_between(1, 16384);
        else if (row.code == spv::OpImageQueryLevels)
            known = whole_between(1, 15);
        else if (row.code == spv::OpImageQueryLod)
            known = between(-1000, 1000);
        results.push_back(builder_.add({.code = kTexel, .part = i, .scalar = info.result.scalar}, {}, known));
    }
    return results;
}

Range OperationUnroller::texel(const evaluate::ImageCall& call, const Slots& slots, std::uint32_t component) {
    if (call.reference != 0) return between(0, 1);
    // The stage itself may have written it.
    if (call.is_storage != 0) return call.has_int_result != 0 ? kAnyInt : kAnything;
    const Id image = builder_.expressions().origin(slots[call.image - 1]);
    Range all = kNothing;
    for (std::size_t index = 0; index < program_.images.size(); ++index) {
        if (builder_.expressions().all[image].code == kConstant &&
            builder_.expressions().known[image].low != static_cast<double>(index))
            continue;
        const auto field =
            std::ranges::find(space_.fields, program_.images[index].name, &sanitize::InputField::name);
        if (field == space_.fields.end()) return call.has_int_result != 0 ? kAnyInt : kAnything;
        for (std::size_t channel = 0; channel < std::min<std::size_t>(4, field->channels.size()); ++channel) {
            if (call.component == 0 && channel != component) continue;  // else which one a gather is told
            const Domain& domain = field->channels[channel];
            all = hull(all, call.has_int_result != 0
                                ? whole_numbers(field->scalar, domain.low, domain.high)
                                : between(nearest_float(domain.low), nearest_float(domain.high)));
            for (const double also : domain.also)
                all = hull(all, call.has_int_result != 0 ? whole_numbers(field->scalar, also, also)
                                                         : exactly(nearest_float(also)));
        }
    }
    return hull(all, exactly(0));
}

OperationUnroller::Id OperationUnroller::clamped_index(Id index, std::size_t count) {
    return builder_.make({.code = extended(GLSLstd450SClamp), .scalar = Scalar::int32},
                         {index, builder_.constant(0, Scalar::int32),
                          builder_.constant(static_cast<double>(count) - 1, Scalar::int32)});
}

std::vector<std::uint32_t> OperationUnroller::possible_offsets(Id offset) {
    const Range& range = builder_.ranges().range(offset);
    if (range.is_one()) return {static_cast<std::uint32_t>(range.low)};
    std::vector<std::uint32_t> all;
    const auto known = offsets_.find(builder_.expressions().origin(offset));
    if (known != offsets_.end())
        for (const std::uint32_t one : known->second)
            if (one >= range.low && one <= range.high) all.push_back(one);
    if (known == offsets_.end())
        for (double one = std::max(0.0, range.low); one <= std::min(range.high, 4096.0); ++one)
            all.push_back(static_cast<std::uint32_t>(one));
    return all;
}

std::vector<OperationUnroller::Id> OperationUnroller::gather(const Operation& operation, Slots& slots) {
    const Id offset = slots[operation.operands[1]];
    std::vector<Id> results;
    const std::vector<std::uint32_t> offsets = possible_offsets(offset);
    for (std::uint32_t i = 0; i < operation.count; ++i) {
        std::vector<Id> all;
        for (const std::uint32_t at : offsets) all.push_back(slot_at(slots, operation.operands[0] + i + at));
        results.push_back(all.size() == 1 ? builder_.plain(all.front())
                                          : builder_.indexed(offset, all, offsets));
    }
    return results;
}

std::vector<OperationUnroller::Id> OperationUnroller::scatter(const Operation& operation, Slots& slots) {
    const Id offset = slots[operation.operands[1]];
    const std::vector<std::uint32_t> offsets = possible_offsets(offset);
    for (const std::uint32_t at : offsets)
        for (std::uint32_t i = 0; i < operation.count; ++i) {
            const std::uint32_t slot = operation.result + i + at;
            if (slot >= slots.size()) continue;
            const Id given = slots[operation.operands[0] + i];
            slots[slot] = offsets.size() == 1 ? builder_.plain(given)
                                              : builder_.replaced(offset, at, given, slots[slot]);
        }
    return {};
}

}  // namespace gobo::prove
