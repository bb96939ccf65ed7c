// Intervals hold what floats give, rounded and flushed.
#include "lab/prove/range.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "lab/sanitize/input_space.hpp"

namespace gobo {
namespace {

using prove::Range;

bool holds(const Range& range, float number) {
    if (std::isnan(number)) return range.nan;
    const double value = static_cast<double>(number);
    if (value == 0) return range.holds_zero();
    return value >= range.low && value <= range.high && std::fabs(value) >= range.least;
}

/// As a processor that flushes denormals sees it.
float flushed(float number) {
    return std::fabs(number) < std::numeric_limits<float>::min() ? 0.0F : number;
}

float drawn(sanitize::Random& random) {
    const int exponent = static_cast<int>(random.between(-140, 60));
    const float size = std::ldexp(static_cast<float>(random.between(0.5, 1)), exponent);
    if (random.one_in(8)) return random.one_in(2) ? 0.0F : 1.0F;
    return random.one_in(2) ? size : -size;
}

struct Row {
    std::string name;
    std::function<Range(const Range&, const Range&)> of_ranges;
    std::function<float(float, float)> of_floats;
};

class RangeArithmetic : public testing::TestWithParam<Row> {};

TEST_P(RangeArithmetic, HoldsWhatFloatsGive) {
    sanitize::Random random(7);
    const Row& row = GetParam();
    for (int trial = 0; trial < 20000; ++trial) {
        const float a[] = {drawn(random), drawn(random)};
        const float b[] = {drawn(random), drawn(random)};
        const auto between = [](const float* ends) {
            Range range = prove::hull(prove::exactly(static_cast<double>(ends[0])),
                                      prove::exactly(static_cast<double>(ends[1])));
            return range;
        };
        const Range x = between(a);
        const Range y = between(b);
        if (row.name == "quotient" && y.holds_zero()) continue;
        const Range result = row.of_ranges(x, y);
        for (const float first : a)
            for (const float second : b) {
                const float number = row.of_floats(first, second);
                ASSERT_TRUE(holds(result, number)) << first << " " << second << " " << number;
                const float small = flushed(row.of_floats(flushed(first), flushed(second)));
                ASSERT_TRUE(holds(result, small) || std::isnan(small))
                    << "flushed " << first << " " << second << " " << small;
            }
    }
}

const Row kRows[] = {
    {"sum", [](const Range& a, const Range& b) { return rounded(sum(a, b)); },
     [](float a, float b) { return a + b; }},
    {"product", [](const Range& a, const Range& b) { return rounded(product(a, b)); },
     [](float a, float b) { return a * b; }},
    {"quotient", [](const Range& a, const Range& b) { return rounded(quotient(a, b)); },
     [](float a, float b) { return a / b; }},
    {"square", [](const Range& a, const Range&) { return rounded(square(a)); },
     [](float a, float) { return a * a; }},
    {"smaller", [](const Range& a, const Range& b) { return smaller(a, b); },
     [](float a, float b) { return b < a ? b : a; }},
    {"larger", [](const Range& a, const Range& b) { return larger(a, b); },
     [](float a, float b) { return a < b ? b : a; }},
    {"size", [](const Range& a, const Range&) { return size_of(a); },
     [](float a, float) { return std::fabs(a); }},
};

INSTANTIATE_TEST_SUITE_P(Operations, RangeArithmetic, testing::ValuesIn(kRows),
                         [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

TEST(RangeArithmetic, LeavesOutWhatIsNearerToZeroThanTheGrid) {
    Range whole = prove::whole_between(-3, 3);
    whole.zero = false;
    whole = prove::tidy(whole);
    EXPECT_EQ(whole.smallest(), 1);
    EXPECT_FALSE(prove::product(whole, whole).holds_zero());
    EXPECT_TRUE(prove::both(whole, prove::exactly(0)).is_empty());
}

}  // namespace
}  // namespace gobo
