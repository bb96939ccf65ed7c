// The measure of lost precision names the operation that loses it.
#include "lab/sanitize/precision.hpp"

#include <ostream>

#include <gtest/gtest.h>

#include "sanitize_support.hpp"

namespace gobo {
namespace {

struct Row {
    std::string name;
    std::string body;  ///< lines from 5 on
    int line;          ///< of what loses most
    std::string operation;
    double error_from;  ///< the largest error lies within
    double error_to;
};

std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
}

// 2^-24 is 6e-8.
const Row kRows[] = {
    // Sums of up to 1e4 are off by up to 5e-4 before what is left over is looked at.
    {"cancellation", "float large = a * 100.0 + b;\nfloat rest = large - a * 100.0;\ncolor = vec4(rest);", 5,
     "FAdd", 1e-7, 5e-4},
    // The product of up to 1e4 times 2 pi is off by 4e-3 and more, the sine follows it.
    {"large_angle", "float angle = a * b * 6.2831853;\ncolor = vec4(sin(angle));", 5, "FMul", 1e-4, 2e-2},
    // 1 - cosine, for small angles.
    {"one_minus_cosine", "float c = cos(a * 1e-3);\ncolor = vec4((1.0 - c) * 1e6);", 5, "Cos", 1e-4, 10},
    {"power", "float base = 1.0 + abs(a) * 1e-5;\ncolor = vec4(pow(base, 1e4));", 5, "FAdd", 1e-4, 2e-3},
};

class Precision : public testing::TestWithParam<Row> {};

sanitize::PrecisionReport precision_of(const std::string& body) {
    const std::string text =
        "#version 450\n"
        "layout(location = 0) in float a; layout(location = 1) in float b;\n"
        "layout(location = 0) out vec4 color;\n"
        "void main() {\n" +
        body + "\n}\n";
    const evaluate::Program program = program_of("precision.frag", text);
    const sanitize::InputSpace space = sanitize::input_space_of(program, {});
    const auto report = sanitize::measure_precision(program, space, 4096, 1);
    EXPECT_TRUE(report);
    return *report;
}

TEST_P(Precision, IsLostWhereTheTableSays) {
    const sanitize::PrecisionReport report = precision_of(GetParam().body);
    ASSERT_EQ(report.outputs.size(), 1U);
    const sanitize::OutputLoss& loss = report.outputs.front();
    EXPECT_EQ(loss.output, "color");
    EXPECT_GE(loss.error, GetParam().error_from);
    EXPECT_LE(loss.error, GetParam().error_to);
    ASSERT_FALSE(loss.contributions.empty());
    EXPECT_EQ(loss.contributions.front().place.line, GetParam().line);
    EXPECT_EQ(loss.contributions.front().operation, GetParam().operation);
    EXPECT_GT(loss.contributions.front().change, loss.all_contributions / 2);
}

INSTANTIATE_TEST_SUITE_P(Rows, Precision, testing::ValuesIn(kRows), row_name);

TEST(PrecisionOfExactArithmetic, IsWhole) {
    EXPECT_TRUE(precision_of("color = vec4(a * 0.5, -b, abs(a), max(a, b));").outputs.empty());
}

/// A step is no rounding: where fp32 stands on the other side, the point is counted and left out.
TEST(PrecisionAcrossASteps, IsNotMeasured) {
    const sanitize::PrecisionReport report =
        precision_of("color = vec4(a * 3.0 > b * 3.0000001 ? 1.0 : 0.0);");
    EXPECT_TRUE(report.outputs.empty());
    EXPECT_GT(report.decided_otherwise, 0U);
    EXPECT_LT(report.decided_otherwise, report.points);
}

TEST(PrecisionReport, IsTheSameEachTime) {
    const sanitize::PrecisionReport first = precision_of("color = vec4(sin(a * b));");
    const sanitize::PrecisionReport second = precision_of("color = vec4(sin(a * b));");
    ASSERT_EQ(first.outputs.size(), 1U);
    EXPECT_EQ(first.outputs.front().error, second.outputs.front().error);
    EXPECT_EQ(first.outputs.front().point.inputs, second.outputs.front().point.inputs);
}

}  // namespace
}  // namespace gobo
