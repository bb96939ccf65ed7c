// How long vectors are at most, and what is no larger than what else, by how they are computed.
#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/ranges.hpp"

namespace gobo::prove {

std::optional<Range> Ranges::declared_length(const std::uint32_t* vector, std::uint32_t count) const {
    const Expression& first = expressions_.all[expressions_.origin(vector[0])];
    if (first.code != kInput) return std::nullopt;
    const sanitize::InputField& field = space_.fields[first.field];
    if (!field.domain.of_length || count != field.ranged()) return std::nullopt;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Expression& one = expressions_.all[expressions_.origin(vector[i])];
        if (one.code != kInput || one.field != first.field || one.part != i) return std::nullopt;
    }
    // Components are rounded to floats after the vector has been given its length.
    constexpr double kSlack = 0x1p-22;
    Range range{
        field.domain.low * (1 - kSlack), field.domain.high * (1 + kSlack), 0, kFinestGrid, false, false};
    range.least = range.low;
    range.zero = range.low <= 0;
    for (const double also : field.domain.also) {
        range.low = std::min(range.low, also);
        range.high = std::max(range.high, also);
        range.least = also == 0 ? range.least : std::min(range.least, also);
        range.zero = range.zero || also == 0;
    }
    return tidy(range);
}

double Ranges::length_limit(const std::uint32_t* vector, std::uint32_t count, int depth) const {
    constexpr int kDeepest = 12;
    double square = 0;
    std::array<std::uint32_t, 4> origins{};
    if (count > origins.size()) return kInfinity;
    for (std::uint32_t i = 0; i < count; ++i) {
        origins[i] = expressions_.origin(vector[i]);
        const Range& range = known_[vector[i]].range;
        if (range.nan) return kInfinity;
        square += range.has_no_number() ? 0 : range.size() * range.size();
    }
    const double by_components = std::sqrt(square) * (1 + 1e-12);
    if (depth > kDeepest || expressions_.has_relaxed) return by_components;
    const Expression& first = expressions_.all[origins[0]];
    for (std::uint32_t i = 1; i < count; ++i) {
        const Expression& other = expressions_.all[origins[i]];
        if (other.code != first.code || other.count != first.count) return by_components;
    }
    if (const auto declared = declared_length(vector, count)) return std::min(by_components, declared->high);
    constexpr double kStep = 1 + 0x1p-22;
    // The same operand of each component.
    std::array<std::uint32_t, 4> parts{};
    const auto limit_of = [&](std::uint32_t operand) {
        for (std::uint32_t i = 0; i < count; ++i) parts[i] = expressions_.operand(origins[i], operand);
        return length_limit(parts.data(), count, depth + 1);
    };
    const auto shares = [&](std::uint32_t operand) {
        for (std::uint32_t i = 1; i < count; ++i)
            if (expressions_.origin(expressions_.operand(origins[i], operand)) !=
                expressions_.origin(expressions_.operand(origins[0], operand)))
                return false;
        return true;
    };
    const std::uint32_t* operands = expressions_.operands_of(origins[0]);
    double limit = by_components;
    switch (first.code) {
        case spv::OpFNegate:
            limit = limit_of(0);
            break;
        case spv::OpFAdd:
        case spv::OpFSub:
            limit = (limit_of(0) + limit_of(1)) * kStep;
            break;
        case spv::OpFMul:
        case spv::OpVectorTimesScalar:
            if (shares(1)) {
                if (makes_unit(origins.data(), count)) return std::min(by_components, 1 + kUnitSlack);
                limit = limit_of(0) * known_[operands[1]].range.size() * kStep;
            } else if (shares(0)) {
                limit = limit_of(1) * known_[operands[0]].range.size() * kStep;
            }
            break;
        case spv::OpFDiv:
            if (!shares(1)) break;
            for (std::uint32_t i = 0; i < count; ++i) parts[i] = expressions_.operand(origins[i], 0);
            if (divides_by_length(parts.data(), count, operands[1]))
                return std::min(by_components, 1 + kDirectionSlack);
            limit = limit_of(0) / std::max(known_[operands[1]].range.smallest(), kSmallestFloat) * kStep;
            break;
        case kJoined: {
            const std::vector<std::uint32_t>& from = expressions_.lists[first.field];
            for (std::uint32_t i = 1; i < count; ++i)
                if (expressions_.all[origins[i]].field != first.field) return by_components;
            limit = 0;
            for (std::uint32_t way = 0; way < first.count; ++way)
                if (reached_[from[way]]) limit = std::max(limit, limit_of(way));
            break;
        }
        case extended(GLSLstd450Normalize):
            if (count == first.count && known_[origins[0]].range.size() < 2) limit = 1 + kDirectionSlack;
            break;
        case extended(GLSLstd450Cross):
            limit = length_limit(operands, 3, depth + 1) * length_limit(operands + 3, 3, depth + 1) *
                    (1 + 4 * kStep - 4);
            break;
        case extended(GLSLstd450Reflect): {
            const double incident = length_limit(operands, count, depth + 1);
            const double normal = length_limit(operands + count, count, depth + 1);
            if (2 * count != first.count) break;
            limit = incident * std::sqrt(1 + 4 * normal * normal * std::max(0.0, normal * normal - 1)) +
                    0x1p-21 * incident * (1 + 2 * normal * normal);
            break;
        }
        default:
            break;
    }
    return std::isnan(limit) ? by_components : std::min(limit, by_components);
}

bool Ranges::makes_unit(const std::uint32_t* products, std::uint32_t count) const {
    if (expressions_.has_relaxed) return false;
    // v * inversesqrt(max(dot(v, v), least)), or without max().
    const std::uint32_t root = expressions_.origin(expressions_.operand(products[0], 1));
    if (expressions_.all[root].code != extended(GLSLstd450InverseSqrt)) return false;
    const std::uint32_t under_root = expressions_.operand(root, 0);
    if (known_[under_root].range.low < 1e-31 || known_[under_root].range.nan) return false;
    const auto is_square_of_all = [&](std::uint32_t candidate) {
        candidate = expressions_.origin(candidate);
        const Expression& sum = expressions_.all[candidate];
        if (sum.code != kSumOfProducts) return false;
        const std::uint32_t terms = sum.count / 2;
        for (std::uint32_t i = 0; i < terms; ++i)
            if (expressions_.origin(expressions_.operand(candidate, i)) !=
                expressions_.origin(expressions_.operand(candidate, terms + i)))
                return false;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t factor = expressions_.origin(expressions_.operand(products[i], 0));
            bool is_among = false;
            for (std::uint32_t k = 0; k < terms; ++k) {
                // Each component once.
                const bool is_this = expressions_.origin(expressions_.operand(candidate, k)) == factor;
                is_among = is_among || (is_this && (count == 1 || k == i));
            }
            if (!is_among) return false;
        }
        return true;
    };
    const std::uint32_t origin = expressions_.origin(under_root);
    if (expressions_.all[origin].code == extended(GLSLstd450FMax))
        return is_square_of_all(expressions_.operand(origin, 0)) ||
               is_square_of_all(expressions_.operand(origin, 1));
    return is_square_of_all(origin);
}

bool Ranges::is_at_most(std::uint32_t a, std::uint32_t b, int depth) const {
    constexpr int kDeepest = 8;
    const Range& range = known_[a].range;
    if (range.nan || known_[b].range.nan) return false;
    if (range.size() <= known_[b].range.low) return true;
    a = expressions_.origin(a);
    b = expressions_.origin(b);
    if (a == b && range.low >= 0) return true;
    bool is_strict = false;
    if (range.low >= 0 && is_before(a, b, is_strict)) return true;
    if (depth > kDeepest) return false;
    const Expression& larger = expressions_.all[b];
    const std::uint32_t* operands = expressions_.operands_of(b);
    if (larger.code == extended(GLSLstd450FAbs)) {
        const std::uint32_t inner = expressions_.origin(operands[0]);
        if (inner == a) return true;
        const Expression& also = expressions_.all[a];
        if (also.code == extended(GLSLstd450FAbs) && expressions_.origin(expressions_.operand(a, 0)) == inner)
            return true;
    }
    // a - c <= a - b where b <= c, both sums of nothing that a variant of arithmetic would regroup.
    const Expression& smaller = expressions_.all[a];
    if (larger.code == spv::OpFSub && smaller.code == spv::OpFSub && range.low >= 0) {
        const std::uint32_t* others = expressions_.operands_of(a);
        const std::uint32_t from = expressions_.origin(operands[0]);
        const auto is_plain = [&](std::uint32_t one) {
            return !known_[one].has_product && !known_[one].has_terms;
        };
        if (expressions_.origin(others[0]) == from && is_plain(others[0]) && is_plain(others[1]) &&
            is_plain(operands[1]) &&
            (expressions_.origin(operands[1]) == expressions_.origin(others[1]) ||
             is_before(expressions_.origin(operands[1]), expressions_.origin(others[1]), is_strict)))
            return true;
    }
    // a <= a + c where c is not negative, however sums are regrouped, if c is none.
    if (larger.code == spv::OpFAdd && range.low >= 0)
        for (std::uint32_t i = 0; i < 2; ++i) {
            const Known& other = known_[operands[1 - i]];
            if (expressions_.origin(operands[i]) == a && other.range.low >= 0 && !other.range.nan &&
                !other.has_terms)
                return true;
        }
    if (larger.code == extended(GLSLstd450FMax))
        return is_at_most(a, operands[0], depth + 1) || is_at_most(a, operands[1], depth + 1);
    return false;
}

}  // namespace gobo::prove
