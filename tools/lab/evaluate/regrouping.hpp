// Arithmetic that computes sums otherwise than written, as compilers of GLSL may. Internal to evaluation.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/registers.hpp"

namespace gobo::evaluate {

/// Remembers of each slot and lane of which two numbers its value is the product (fused) or the sum
/// (regrouped, reordered), wherever it has been copied since, and computes later additions from those:
/// across variables, calls and turns of loops, as a compiler sees them once it has inlined and unrolled all.
/// Neither what `precise` marks is regrouped, nor the parts of what it marks.
template <class T>
class Regrouping {
  public:
    Regrouping(const Program& program, Registers<T>& registers, Sums sums)
        : program_(program),
          registers_(registers),
          sums_(sums),
          parts_(std::size_t{program.slots} * kLanes),
          known_(program.slots, 0) {}

    /// Nothing is known of any slot.
    void begin() { std::fill(known_.begin(), known_.end(), 0); }

    /// Computes the operation, of index `at`, where it is an addition whose parts are known. False: the
    /// operation is to be run as always, and after() to be called.
    [[nodiscard]] bool takes_over(std::uint32_t at) {
        const Operation& operation = program_.operations[at];
        const std::uint32_t code = row_of(operation).code;
        if (program_.infos[at].is_precise || (code != spv::OpFAdd && code != spv::OpFSub)) return false;
        add(operation, code == spv::OpFSub);
        return true;
    }

    void after(std::uint32_t at) {
        const Operation& operation = program_.operations[at];
        const Slice& result = program_.infos[at].result;
        const std::uint32_t code = row_of(operation).code;
        const std::uint32_t* words = registers_.words(operation);
        const bool is_free = !program_.infos[at].is_precise;
        switch (code) {
            case spv::OpFMul:
            case spv::OpVectorTimesScalar:
            case spv::OpMatrixTimesScalar:
                if (is_free && sums_ == Sums::fused) return remember(operation, code != spv::OpFMul);
                break;
            case spv::OpFNegate:
                if (is_free) return negate(operation);
                break;
            case kCopy:
            case spv::OpStore:
                return copy(operation);
            case spv::OpLoad:
            case spv::OpCompositeExtract:
                return copy(operation.result, operation.operands[0], operation.count, kAllLanes);
            case spv::OpCompositeConstruct: {
                std::uint32_t to = operation.result;
                for (std::uint32_t word = 0; word < operation.extras; to += words[word + 1], word += 2)
                    copy(to, words[word], words[word + 1], kAllLanes);
                return;
            }
            case spv::OpCompositeInsert:
                copy(operation.result, operation.operands[1], operation.count, kAllLanes);
                return copy(operation.result + words[0], operation.operands[0], words[1], kAllLanes);
            case spv::OpVectorShuffle:
                for (std::uint32_t component = 0; component < operation.count; ++component)
                    copy(operation.result + component, words[component], 1, kAllLanes);
                return;
            case kScatter:
                for (std::uint32_t component = 0; component < operation.count; ++component)
                    for (std::size_t lane = 0; lane < kLanes; ++lane) {
                        const auto offset =
                            static_cast<std::uint32_t>(registers_.ints(operation.operands[1])[lane]);
                        known_[operation.result + component + offset] &= ~(LaneMask{1} << lane);
                    }
                return;
            case kExtended + GLSLstd450ModfStruct:
            case kExtended + GLSLstd450FrexpStruct:
                return forget(operation.result, 2 * operation.count);
            default:
                break;
        }
        forget(result.slot, result.count);
    }

    /// The active lanes have been copied.
    void copy(const Operation& operation) {
        copy(operation.result, operation.operands[0], operation.count, registers_.active());
    }

  private:
    struct Parts {
        T first;
        T second;
    };
    [[nodiscard]] Parts* parts(std::uint32_t slot) { return parts_.data() + std::size_t{slot} * kLanes; }

    /// The factors of a product, of all lanes.
    void remember(const Operation& operation, bool is_scaled) {
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            const T* a = registers_.floats(operation.operands[0] + component);
            const T* b = registers_.floats(operation.operands[1] + (is_scaled ? 0 : component));
            Parts* known = parts(operation.result + component);
            for (std::size_t lane = 0; lane < kLanes; ++lane) known[lane] = {a[lane], b[lane]};
            known_[operation.result + component] = kAllLanes;
        }
    }

    /// -(a b) is (-a) b, and -(a + b) is (-a) + (-b).
    void negate(const Operation& operation) {
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            const Parts* from = parts(operation.operands[0] + component);
            Parts* to = parts(operation.result + component);
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                to[lane] = {-from[lane].first, sums_ == Sums::fused ? from[lane].second : -from[lane].second};
            known_[operation.result + component] = known_[operation.operands[0] + component];
        }
    }

    void forget(std::uint32_t slot, std::uint32_t count) { std::fill_n(known_.begin() + slot, count, 0); }

    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t count, LaneMask lanes) {
        if (to == from) return;
        for (std::uint32_t component = 0; component < count; ++component) {
            const LaneMask copied = known_[from + component] & lanes;
            known_[to + component] = (known_[to + component] & ~lanes) | copied;
            for (std::size_t lane = 0; lane < kLanes && copied != 0; ++lane)
                if (has_lane(copied, lane)) parts(to + component)[lane] = parts(from + component)[lane];
        }
    }

    void add(const Operation& operation, bool is_difference) {
        forget(operation.result, operation.count);
        for (std::uint32_t component = 0; component < operation.count; ++component)
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                add_lane(operation, component, lane, is_difference ? T(-1) : T(1));
    }

    /// x + sign y, from the parts of x where they are known, otherwise from those of y.
    void add_lane(const Operation& operation, std::uint32_t component, std::size_t lane, T sign) {
        const std::uint32_t slots[] = {operation.operands[0] + component, operation.operands[1] + component};
        const std::uint32_t to = operation.result + component;
        const T x = registers_.floats(slots[0])[lane];
        const T y = sign * registers_.floats(slots[1])[lane];
        T& result = registers_.floats(to)[lane];
        const bool knows_x = has_lane(known_[slots[0]], lane);
        const bool knows_y = has_lane(known_[slots[1]], lane);
        Parts of = knows_x ? parts(slots[0])[lane] : parts(slots[1])[lane];
        if (sums_ == Sums::fused) {
            const T factor = knows_x ? of.first : sign * of.first;
            result = knows_x || knows_y ? std::fma(factor, of.second, knows_x ? y : x) : x + y;
            return;
        }
        if (!knows_x) of = {sign * of.first, sign * of.second};
        Parts now{x, y};
        if (knows_x || knows_y)
            now = regroup(of, knows_x ? y : x, result);
        else
            result = x + y;
        parts(to)[lane] = now;
        known_[to] |= LaneMask{1} << lane;
    }

    /// (first + second) + other; the parts of the sum. What cancels is not computed at all.
    Parts regroup(Parts known, T other, T& sum) const {
        if (other == -known.first)
            known = {known.second, T(0)};
        else if (other == -known.second)
            known = {known.first, T(0)};
        else if (sums_ == Sums::regrouped)
            known = {known.first, known.second + other};
        else
            known = {known.first + other, known.second};
        sum = known.first + known.second;
        return known;
    }

    const Program& program_;
    Registers<T>& registers_;
    Sums sums_;
    std::vector<Parts> parts_;     ///< of each slot and lane
    std::vector<LaneMask> known_;  ///< of each slot: lanes with parts
};

}  // namespace gobo::evaluate
