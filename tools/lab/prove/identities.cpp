// What intervals cannot see: identities of vectors that hold whatever their components are.
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/comparison.hpp"
#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

/// Of a few operations on numbers of about 1, each off by a few roundings.
constexpr double kSlack = 1e-5;

}  // namespace

double Ranges::least_in(std::uint32_t context, std::uint32_t expression) const {
    double least = known_[expression].range.low;
    const std::uint32_t origin = expressions_.origin(expression);
    for (; context != 0; context = expressions_.contexts[context].parent) {
        const Context& inside = expressions_.contexts[context];
        const std::uint32_t condition = expressions_.origin(inside.condition);
        const Comparison* comparison = comparison_of(expressions_.all[condition].code);
        if (comparison == nullptr || !inside.is_true || (comparison->when_true & (kLess | kUnordered)) != 0)
            continue;
        const std::uint32_t* operands = expressions_.operands_of(condition);
        if (expressions_.origin(operands[0]) == origin)
            least = std::max(least, known_[operands[1]].range.low);
    }
    return least;
}

bool Ranges::is_largest_of(std::uint32_t scale, const std::uint32_t* vector, std::uint32_t count,
                           double least) const {
    scale = expressions_.origin(scale);
    const Expression& expression = expressions_.all[scale];
    if (expression.code == extended(GLSLstd450FMax))
        return is_largest_of(expressions_.operand(scale, 0), vector, count, least) &&
               is_largest_of(expressions_.operand(scale, 1), vector, count, least);
    if (expression.code == kConstant) return expressions_.known[scale].high < least;
    if (expression.code != extended(GLSLstd450FAbs)) return false;
    const std::uint32_t inner = expressions_.origin(expressions_.operand(scale, 0));
    for (std::uint32_t i = 0; i < count; ++i)
        if (expressions_.origin(vector[i]) == inner) return true;
    return false;
}

// With total = fl(s + y): fl(total - s) is y and fl(fl(total - s) - y) is 0, but for roundings (Kahan's
// compensated sum).
std::optional<Range> Ranges::rounding_of_sum(std::uint32_t x, std::uint32_t y) const {
    const auto is_precise_sum = [&](std::uint32_t expression) {
        const Expression& sum = expressions_.all[expression];
        return sum.code == spv::OpFAdd && sum.is_precise;
    };
    const auto slack = [&](std::uint32_t sum) {
        const std::uint32_t* terms = expressions_.operands_of(sum);
        return 8 * kRounding * (known_[terms[0]].range.size() + known_[terms[1]].range.size()) +
               4 * kSmallestNormal;
    };
    x = expressions_.origin(x);
    y = expressions_.origin(y);
    for (std::uint32_t side = 0; side < 2; ++side) {
        if (is_precise_sum(x) && expressions_.origin(expressions_.operand(x, side)) == y) {
            const Range& rest = known_[expressions_.operand(x, 1 - side)].range;
            const double most = slack(x);
            if (!rest.nan && !rest.has_no_number() && most < kLargestFloat) return widened_by(rest, most);
        }
        const Expression& difference = expressions_.all[x];
        if (difference.code != spv::OpFSub || !difference.is_precise) continue;
        const std::uint32_t total = expressions_.origin(expressions_.operand(x, 0));
        if (!is_precise_sum(total)) continue;
        const bool is_this = expressions_.origin(expressions_.operand(total, side)) ==
                                 expressions_.origin(expressions_.operand(x, 1)) &&
                             expressions_.origin(expressions_.operand(total, 1 - side)) == y;
        const double most = slack(total);
        if (is_this && most < kLargestFloat) return between(-most, most);
    }
    return std::nullopt;
}

bool Ranges::divides_by_length(const std::uint32_t* vector, std::uint32_t count,
                               std::uint32_t divisor) const {
    if (expressions_.has_relaxed) return false;
    const Range& length = known_[divisor].range;
    if (length.nan || length.smallest() < 1e-15 || length.high > 1e18) return false;
    divisor = expressions_.origin(divisor);
    const Expression* expression = &expressions_.all[divisor];
    std::uint32_t terms = expression->count;
    if (expression->code == extended(GLSLstd450Sqrt)) {
        divisor = expressions_.origin(expressions_.operand(divisor, 0));
        expression = &expressions_.all[divisor];
        if (expression->code != kSumOfProducts) return false;
        terms = expression->count / 2;
        for (std::uint32_t i = 0; i < terms; ++i)
            if (expressions_.origin(expressions_.operand(divisor, i)) !=
                expressions_.origin(expressions_.operand(divisor, terms + i)))
                return false;
    } else if (expression->code != extended(GLSLstd450Length)) {
        return false;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        bool is_among = false;
        for (std::uint32_t k = 0; k < terms; ++k)
            is_among = is_among ||
                       ((count == 1 || k == i) && expressions_.origin(expressions_.operand(divisor, k)) ==
                                                      expressions_.origin(vector[i]));
        if (!is_among) return false;
    }
    return true;
}

std::optional<std::array<std::uint32_t, 3>> Ranges::vector_of_square(std::uint32_t square) const {
    square = expressions_.origin(square);
    if (expressions_.has_relaxed) return std::nullopt;
    if (known_[square].range.low < 1e-31 || known_[square].range.nan) return std::nullopt;
    std::uint32_t sum = square;
    if (expressions_.all[square].code == extended(GLSLstd450FMax))
        for (std::uint32_t i = 0; i < 2; ++i) {
            const std::uint32_t operand = expressions_.origin(expressions_.operand(square, i));
            if (expressions_.all[operand].code == kSumOfProducts) sum = operand;
        }
    if (expressions_.all[sum].code != kSumOfProducts || expressions_.all[sum].count != 6) return std::nullopt;
    std::array<std::uint32_t, 3> vector{};
    for (std::uint32_t i = 0; i < 3; ++i) {
        vector[i] = expressions_.origin(expressions_.operand(sum, i));
        if (vector[i] != expressions_.origin(expressions_.operand(sum, 3 + i))) return std::nullopt;
    }
    return vector;
}

// |n.h| <= |n| |h|, which is |n| of a unit vector, however h is made one.
double Ranges::cosine_limit(std::uint32_t sum, std::uint32_t inverse_length) const {
    sum = expressions_.origin(sum);
    inverse_length = expressions_.origin(inverse_length);
    if (expressions_.all[inverse_length].code != extended(GLSLstd450InverseSqrt)) return kInfinity;
    if (expressions_.all[sum].code != kSumOfProducts || expressions_.all[sum].count != 6) return kInfinity;
    const auto h = vector_of_square(expressions_.operand(inverse_length, 0));
    if (!h) return kInfinity;
    const std::uint32_t* factors = expressions_.operands_of(sum);
    double limit = kInfinity;
    for (std::uint32_t side = 0; side < 2; ++side) {
        bool is_this = true;
        for (std::uint32_t i = 0; i < 3; ++i)
            is_this = is_this && expressions_.origin(factors[3 * side + i]) == (*h)[i];
        if (is_this) limit = std::min(limit, length_limit(factors + 3 - 3 * side, 3) * (1 + kSlack) + 1e-20);
    }
    return limit;
}

// |n x h|^2 = |n|^2 |h|^2 - (n.h)^2 (Lagrange): of the square of a sine, |n x h|^2 / |h|^2, a cosine that is
// known leaves little.
double Ranges::sine_limit(std::uint32_t square_of_cross, std::uint32_t square) const {
    const std::uint32_t numerator = expressions_.origin(square_of_cross);
    const std::uint32_t divisor = expressions_.origin(square);
    if (expressions_.all[numerator].code != kSumOfProducts || expressions_.all[numerator].count != 6)
        return kInfinity;
    const std::uint32_t* cross = expressions_.operands_of(numerator);
    for (std::uint32_t i = 0; i < 3; ++i)
        if (expressions_.origin(cross[i]) != expressions_.origin(cross[3 + i])) return kInfinity;
    const auto of_square = vector_of_square(divisor);
    if (!of_square) return kInfinity;
    const std::array<std::uint32_t, 3>& h = *of_square;
    const auto is_same = [&](const std::uint32_t* a, const std::uint32_t* b) {
        for (std::uint32_t i = 0; i < 3; ++i)
            if (expressions_.origin(a[i]) != expressions_.origin(b[i])) return false;
        return true;
    };
    std::array<std::uint32_t, 3> n{};
    bool knows_n = false;
    const auto takes_n = [&](const std::uint32_t* vector) {
        if (knows_n) return is_same(n.data(), vector);
        for (std::uint32_t i = 0; i < 3; ++i) n[i] = expressions_.origin(vector[i]);
        return knows_n = true;
    };
    const auto crosses = [&](const std::uint32_t* vector, const std::uint32_t* other,
                             std::uint32_t operand_of_all) {
        // Component i of n x other, where operand_of_all is below 2 as that operand of each component.
        for (std::uint32_t i = 0; i < 3; ++i) {
            std::uint32_t one = expressions_.origin(vector[i]);
            if (operand_of_all < 2) one = expressions_.origin(expressions_.operand(one, operand_of_all));
            const Expression& component = expressions_.all[one];
            const auto is_zero = [&](std::uint32_t expression) {
                expression = expressions_.origin(expression);
                return expressions_.all[expression].code == kConstant &&
                       expressions_.known[expression] == exactly(0);
            };
            if (is_zero(one) && is_zero(other[(i + 1) % 3]) && is_zero(other[(i + 2) % 3])) continue;
            if (component.code != extended(GLSLstd450Cross) || component.part != i) return false;
            const std::uint32_t* operands = expressions_.operands_of(one);
            if (!takes_n(operands) || !is_same(operands + 3, other)) return false;
        }
        return true;
    };
    // How far the square may be off beside the identity, relative to the divisor; of each way that the vector
    // was computed.
    const auto error_of_way = [&](const std::uint32_t* vector, std::uint32_t context) {
        if (crosses(vector, h.data(), 2)) return kSlack;
        // (n x a + n x b) / scale, where h is (a + b) / scale.
        std::array<std::uint32_t, 3> sums{};
        std::array<std::uint32_t, 3> totals{};
        std::array<std::array<std::uint32_t, 3>, 2> terms{};
        std::uint32_t scale = 0;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t quotient = expressions_.origin(vector[i]);
            if (expressions_.all[quotient].code != spv::OpFDiv || expressions_.all[h[i]].code != spv::OpFDiv)
                return kInfinity;
            scale = expressions_.operand(quotient, 1);
            if (expressions_.origin(scale) != expressions_.origin(expressions_.operand(h[i], 1)))
                return kInfinity;
            sums[i] = expressions_.origin(expressions_.operand(quotient, 0));
            totals[i] = expressions_.origin(expressions_.operand(h[i], 0));
            if (expressions_.all[sums[i]].code != spv::OpFAdd ||
                expressions_.all[totals[i]].code != spv::OpFAdd)
                return kInfinity;
            for (std::uint32_t k = 0; k < 2; ++k) terms[k][i] = expressions_.operand(totals[i], k);
        }
        if (!crosses(sums.data(), terms[0].data(), 0) || !crosses(sums.data(), terms[1].data(), 1))
            return kInfinity;
        const double least = least_in(context, scale);
        if (least < 1e-3 || !is_largest_of(scale, totals.data(), 3, least)) return kInfinity;
        // So the largest component of h is 1, and its square at least that.
        const double lengths =
            length_limit(n.data(), 3) * (length_limit(terms[0].data(), 3) + length_limit(terms[1].data(), 3));
        const double error = 16 * kRounding * lengths / least;
        return kSlack + 4 * error * (2 * length_limit(n.data(), 3) + error);
    };
    double error = 0;
    const Expression& first = expressions_.all[expressions_.origin(cross[0])];
    if (first.code == kJoined) {
        const std::vector<std::uint32_t>& from = expressions_.lists[first.field];
        for (std::uint32_t way = 0; way < first.count; ++way) {
            if (!reached_[from[way]]) continue;
            std::array<std::uint32_t, 3> vector{};
            for (std::uint32_t i = 0; i < 3; ++i) {
                const std::uint32_t component = expressions_.origin(cross[i]);
                if (expressions_.all[component].code != kJoined ||
                    expressions_.all[component].field != first.field)
                    return kInfinity;
                vector[i] = expressions_.operand(component, way);
            }
            error = std::max(error, error_of_way(vector.data(), from[way]));
        }
    } else {
        error = error_of_way(cross, 0);
    }
    if (error == kInfinity || !knows_n) return kInfinity;
    // n.h / |h|, where the shader computes it.
    double cosine = 0;
    for (const std::uint32_t root : users_[divisor]) {
        if (expressions_.all[root].code != extended(GLSLstd450InverseSqrt)) continue;
        for (const std::uint32_t product : users_[root]) {
            if (expressions_.all[product].code != spv::OpFMul || !is_computed_[product]) continue;
            for (std::uint32_t i = 0; i < 2; ++i) {
                const std::uint32_t sum = expressions_.origin(expressions_.operand(product, i));
                if (expressions_.all[sum].code != kSumOfProducts || expressions_.all[sum].count != 6)
                    continue;
                const std::uint32_t* factors = expressions_.operands_of(sum);
                const bool is_this = (is_same(factors, n.data()) && is_same(factors + 3, h.data())) ||
                                     (is_same(factors + 3, n.data()) && is_same(factors, h.data()));
                const Range& range = known_[product].range;
                if (is_this && !range.nan) cosine = std::max(cosine, range.smallest() - kSlack);
            }
        }
    }
    const double length = length_limit(n.data(), 3);
    return length * length * (1 + kSlack) - cosine * cosine + error * (1 + length * length);
}

}  // namespace gobo::prove
