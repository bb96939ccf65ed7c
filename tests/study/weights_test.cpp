// Prices of operations: solved for, written, read, and summed up.
#include <gtest/gtest.h>

#include "lab/study/timing.hpp"

namespace gobo::study {
namespace {

using evaluate::Kind;

std::size_t index(Kind kind) {
    return static_cast<std::size_t>(kind);
}

Weighing weighing(std::initializer_list<std::pair<Kind, double>> counts, double nanoseconds) {
    Weighing row;
    for (const auto& [kind, count] : counts) row.counts[index(kind)] = count;
    row.nanoseconds = {nanoseconds, nanoseconds, nanoseconds};
    return row;
}

TEST(Prices, AreFoundWhereTheyExplainTheTimes) {
    // Made from: add 0.5 ns, pow 10 ns, call 0.
    const auto prices = solve_for_prices(
        {weighing({{Kind::add, 4}, {Kind::call, 1}}, 2), weighing({{Kind::pow, 4}, {Kind::call, 1}}, 40),
         weighing({{Kind::call, 1}}, 0), weighing({{Kind::add, 4}, {Kind::pow, 4}, {Kind::call, 2}}, 42)});
    EXPECT_NEAR(prices[index(Kind::add)], 0.5, 1e-3);
    EXPECT_NEAR(prices[index(Kind::pow)], 10, 1e-2);
    EXPECT_NEAR(prices[index(Kind::call)], 0, 1e-3);
}

TEST(Prices, AreNeverNegative) {
    // Noise says that a call saves time.
    const auto prices =
        solve_for_prices({weighing({{Kind::add, 4}}, 2), weighing({{Kind::add, 4}, {Kind::call, 4}}, 1.9)});
    for (const double price : prices) EXPECT_GE(price, 0);
    EXPECT_EQ(prices[index(Kind::call)], 0);
}

Weights some_weights() {
    Weights weights;
    weights.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    weights.nanoseconds = 0.25;
    weights.by_kind[index(Kind::add)] = 1;
    weights.by_kind[index(Kind::pow)] = 40;
    return weights;
}

TEST(WeightsCsv, ComesBackAsItWas) {
    const auto read = read_weights(weights_csv({some_weights()}), "weights.csv");
    ASSERT_TRUE(read);
    ASSERT_EQ(read->size(), 1u);
    EXPECT_EQ(read->front().renderer, some_weights().renderer);
    EXPECT_EQ(read->front().by_kind, some_weights().by_kind);
    EXPECT_DOUBLE_EQ(read->front().nanoseconds, 0.25);
}

struct BadRow {
    const char* name;
    const char* csv;
    const char* message;
    int line;
};

class BadWeights : public testing::TestWithParam<BadRow> {};

TEST_P(BadWeights, AreRefusedAtTheirLine) {
    const auto read = read_weights(GetParam().csv, "weights.csv");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().message, GetParam().message);
    EXPECT_EQ(read.error().front().place.line, GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, BadWeights,
    testing::Values(
        BadRow{"empty", "", "not a table of weights: renderer, kind, weight, nanoseconds", 2},
        BadRow{"unknown_kind", "renderer,kind,weight,nanoseconds\nr,add,1,1\nr,sum,1,1\n",
               "there is no kind of operation 'sum'", 3},
        BadRow{"no_number", "renderer,kind,weight,nanoseconds\nr,add,much,1\n", "'much' is not a weight", 2},
        BadRow{"negative", "renderer,kind,weight,nanoseconds\nr,add,-1,1\n", "'-1' is not a weight", 2}),
    [](const auto& row) { return row.param.name; });

TEST(Costs, SpreadTheVerticesOverTheFragments) {
    Measurement measurement;
    measurement.pixels = 100;
    measurement.shown_vertices = 10;
    measurement.mesh_vertices = 40;
    measurement.work.fragments[index(Kind::add)] = 300;
    measurement.work.fragments[index(Kind::pow)] = 100;
    measurement.work.vertices[index(Kind::add)] = 50;
    const Costs costs = costs_of(measurement, some_weights());
    EXPECT_DOUBLE_EQ(costs.fragment, 3 + 40);
    EXPECT_DOUBLE_EQ(costs.vertex, 5);
    const double fragments = 100.0 * kFullWidth * kFullHeight / (kSampleWidth * kSampleHeight);
    EXPECT_DOUBLE_EQ(costs.vertices_per_fragment, 40 / fragments);
    EXPECT_DOUBLE_EQ(costs.total, 43 + 5 * 40 / fragments);
}

}  // namespace
}  // namespace gobo::study
