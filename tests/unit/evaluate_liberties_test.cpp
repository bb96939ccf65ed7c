// Machines that take the liberties of GLSL: sums computed otherwise than written, NaN either way.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// r.x of a fragment stage with the given a, b, c.
double result_of(const std::string& body, const Options& options, double a, double b, double c,
                 const std::string& declarations = {}) {
    const Program program = fragment_of(body, declarations);
    Invocations invocations;
    invocations.values = {{"a", {a, a, a, a}}, {"b", {b, b, b, b}}, {"c", {c, c, c, c}}};
    const Result<Outputs> outputs = run<float>(program, invocations, options);
    EXPECT_TRUE(outputs);
    return outputs ? outputs->values.at("r")[0] : kNaN;
}

Options on(Sums sums) {
    Options options;
    options.sums = sums;
    return options;
}

struct SumCase {
    const char* name;
    const char* body;
    double a, b, c;
    double as_written, fused, regrouped, reordered;
    const char* declarations = "";
};

void PrintTo(const SumCase& tested, std::ostream* out) {
    *out << tested.name;
}

constexpr double kStep = 0x1p-12;
constexpr double kUlp = 0x1p-24;  // half the distance from 1 to the next float
/// (1 + step)^2 - 1 as floats have it: the square's last term is lost where the product is rounded.
constexpr double kSquare = 2 * kStep;
constexpr double kExactSquare = 2 * kStep + kStep * kStep;

const SumCase kSums[] = {
    {"product_and_sum", "r = a * b + c;", 1 + kStep, 1 + kStep, -1, kSquare, kExactSquare, kSquare, kSquare},
    {"sum_and_product", "r = c + a * b;", 1 + kStep, 1 + kStep, -1, kSquare, kExactSquare, kSquare, kSquare},
    {"product_less_than_subtrahend", "r = c - a * b;", 1 + kStep, 1 + kStep, 1, -kSquare, -kExactSquare,
     -kSquare, -kSquare},
    {"negated_product", "r = -(a * b) + c;", 1 + kStep, 1 + kStep, 1, -kSquare, -kExactSquare, -kSquare,
     -kSquare},
    {"scaled_vector", "r = a * b.x + c;", 1 + kStep, 1 + kStep, -1, kSquare, kExactSquare, kSquare, kSquare},
    {"through_a_variable", "vec4 product = a * b; vec4 other = product; r = other + c;", 1 + kStep, 1 + kStep,
     -1, kSquare, kExactSquare, kSquare, kSquare},
    {"through_a_call", "r = square(a) + c;", 1 + kStep, 0, -1, kSquare, kExactSquare, kSquare, kSquare,
     "vec4 square(vec4 x) { return x * x; }"},
    {"through_a_structure", "Pair p = Pair(a * b, c); r = p.first + p.second;", 1 + kStep, 1 + kStep, -1,
     kSquare, kExactSquare, kSquare, kSquare, "struct Pair { vec4 first; vec4 second; };"},
    {"through_a_loop", "vec4 sum = c; for (int i = 0; i < 1; ++i) sum += a * b; r = sum;", 1 + kStep,
     1 + kStep, -1, kSquare, kExactSquare, kSquare, kSquare},
    {"precise_sum", "precise vec4 sum = a * b + c; r = sum;", 1 + kStep, 1 + kStep, -1, kSquare, kSquare,
     kSquare, kSquare},
    {"overwritten_product", "vec4 product = a * b; product = c + c; r = product + c;", 3, 3, 1, 3, 3, 3, 3},
    {"dot", "r = vec4(dot(vec2(a.x, c.x), vec2(b.x, 1.0)));", 1 + kStep, 1 + kStep, -1, kSquare, kSquare,
     kSquare, kSquare},
    {"dot_of_three", "r = vec4(dot(vec3(c.x, a.x, b.x), vec3(1.0)));", kUlp, kUlp, 1, 1, 1, 1 + 2 * kUlp,
     1 + 2 * kUlp},
    {"mix", "r = mix(a, a, b);", 1 + 0x1p-23, 0.3F, 0, 1 + 0x1p-23, 1 + 0x1p-23, 1 + 0x1p-23, 1 + 0x1p-23},
    {"small_terms_first", "r = (c + a) + b;", kUlp, kUlp, 1, 1, 1, 1 + 2 * kUlp, 1},
    {"small_terms_last", "r = (a + b) + c;", kUlp, kUlp, 1, 1 + 2 * kUlp, 1 + 2 * kUlp, 1, 1},
    {"what_cancels", "r = (c + a) - c;", kUlp, 0, 1, 0, 0, kUlp, kUlp},
    {"compensation",
     "vec4 sum = c; vec4 lost = vec4(0.0);"
     "for (int i = 0; i < 2; ++i) { vec4 y = a - lost; vec4 t = sum + y; lost = (t - sum) - y; sum = t; }"
     "r = sum;",
     kUlp, 0, 1, 1 + 2 * kUlp, 1 + 2 * kUlp, 1, 1 + 2 * kUlp},
    {"precise_compensation",
     "precise vec4 sum = c; precise vec4 lost = vec4(0.0);"
     "for (int i = 0; i < 2; ++i) { precise vec4 y = a - lost; precise vec4 t = sum + y;"
     " lost = (t - sum) - y; sum = t; }"
     "r = sum;",
     kUlp, 0, 1, 1 + 2 * kUlp, 1 + 2 * kUlp, 1 + 2 * kUlp, 1 + 2 * kUlp},
};

class Sum : public testing::TestWithParam<SumCase> {};

TEST_P(Sum, IsComputedAsTheMachineDoes) {
    const SumCase& tested = GetParam();
    const auto result = [&](Sums sums) {
        return result_of(tested.body, on(sums), tested.a, tested.b, tested.c, tested.declarations);
    };
    EXPECT_EQ(result(Sums::as_written), tested.as_written);
    EXPECT_EQ(result(Sums::fused), tested.fused);
    EXPECT_EQ(result(Sums::regrouped), tested.regrouped);
    EXPECT_EQ(result(Sums::reordered), tested.reordered);
}

INSTANTIATE_TEST_SUITE_P(Liberties, Sum, testing::ValuesIn(kSums),
                         [](const auto& tested) { return tested.param.name; });

/// What a product and a difference have in common when fused: a cross product of parallel vectors is not 0.
TEST(Liberties, FusedCrossProductsKeepTheRoundingOfOneProduct) {
    const std::string body = "vec3 v = vec3(a.x, b.x, c.x); r = vec4(cross(v, v), 0.0);";
    EXPECT_EQ(result_of(body, on(Sums::as_written), 0.1, 0.2, 0.3), 0.0);
    EXPECT_NE(result_of(body, on(Sums::fused), 0.1, 0.2, 0.3), 0.0);
}

/// Lanes that part each have their own history.
TEST(Liberties, LanesThatPartAreRememberedApart) {
    const Program program = fragment_of("vec4 x = a; if (b.x > 0.0) x = a * a; r = x + c;");
    Invocations invocations;
    invocations.count = 2;
    invocations.values = {{"a", {1 + kStep, 1 + kStep, 1, 1, 1, 1, 1, 1}},
                          {"b", {1, -1, 0, 0, 0, 0, 0, 0}},
                          {"c", {-1, -1, -1, -1}}};
    const Result<Outputs> outputs = run<float>(program, invocations, on(Sums::fused));
    ASSERT_TRUE(outputs);
    EXPECT_EQ(outputs->values.at("r")[0], kExactSquare);
    EXPECT_EQ(outputs->values.at("r")[1], kStep);
}

struct NaNCase {
    const char* name;
    const char* body;
    double as_written, dropped;  ///< kept gives NaN each time
};

void PrintTo(const NaNCase& tested, std::ostream* out) {
    *out << tested.name;
}

// a is NaN, b and c are 0 and 1
const NaNCase kNaNs[] = {
    {"min_first", "r = min(a, b);", kNaN, 0},        {"min_second", "r = min(b, a);", 0, 0},
    {"max_first", "r = max(a, c);", kNaN, 1},        {"max_second", "r = max(c, a);", 1, 1},
    {"clamp_first", "r = clamp(a, b, c);", kNaN, 0}, {"clamp_low", "r = clamp(c, a, c);", 1, 1},
    {"clamp_high", "r = clamp(b, b, a);", 0, 0},
};

class NaNOperand : public testing::TestWithParam<NaNCase> {};

TEST_P(NaNOperand, IsTakenAsTheMachineDoes) {
    const auto result = [](NaNs nans) {
        Options options;
        options.nans = nans;
        return result_of(GetParam().body, options, kNaN, 0, 1);
    };
    EXPECT_THAT(result(NaNs::by_comparison), testing::NanSensitiveDoubleEq(GetParam().as_written));
    EXPECT_TRUE(std::isnan(result(NaNs::kept)));
    EXPECT_EQ(result(NaNs::dropped), GetParam().dropped);
}

INSTANTIATE_TEST_SUITE_P(Liberties, NaNOperand, testing::ValuesIn(kNaNs),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gobo::evaluate
