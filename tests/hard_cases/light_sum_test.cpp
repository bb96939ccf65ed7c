// A sum of many lights: 4096 terms through each piece that sums lights, by itself, on every machine that GLSL
// allows.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../shipped_pieces.hpp"
#include "../unit/evaluate_support.hpp"
#include "lab/sanitize/machine.hpp"

namespace gobo {
namespace {

constexpr int kTerms = 4096;

/// A series of terms: in GLSL, and its exact sum.
struct Series {
    std::string name;
    std::string term;  ///< of `i`
    double sum;
};

/// Each term is exact in a float, and so is its double sum.
std::vector<Series> all_series() {
    double mixed = 4096;
    for (int i = 1; i < kTerms; ++i) mixed += ((i * 40503) % 65536 + 1) * 0x1p-16;
    return {
        {"equal terms", "0.7", kTerms * static_cast<double>(0.7F)},
        {"a bright light and dim ones", "i == 0 ? 4096.0 : float((i * 40503) % 65536 + 1) / 65536.0", mixed}};
}

std::string stage_of(const std::string& piece, const Series& series) {
    return "#version 450\n#define LIGHT_PRECISION\nlayout(location = 0) out vec4 r;\n" + piece +
           "void main() {\n"
           "    LightSum sum = emptySum();\n"
           "    for (int i = 0; i < 4096; ++i) addTerm(sum, vec3(" +
           series.term +
           "));\n"
           "    r = vec4(totalOf(sum), 1.0);\n"
           "}\n";
}

struct SumPiece {
    std::string name;
    std::string text;
};

void PrintTo(const SumPiece& piece, std::ostream* out) {
    *out << piece.name;
}

std::vector<SumPiece> sum_pieces() {
    std::vector<SumPiece> pieces;
    for (const std::string& path : piece_paths("light_sum/"))
        pieces.push_back({std::filesystem::path(path).stem().string(), piece_text(path)});
    return pieces;
}

double relative_error(const SumPiece& piece, const Series& series, sanitize::Machine machine) {
    const evaluate::Program program =
        evaluate::program_of(evaluate::ShaderStage::fragment, stage_of(piece.text, series));
    const auto outputs = evaluate::run<float>(program, {}, sanitize::options_of(machine));
    EXPECT_TRUE(outputs);
    return outputs ? std::abs(outputs->values.at("r")[0] / series.sum - 1) : 1;
}

class LightSumPiece : public testing::TestWithParam<SumPiece> {};

TEST_P(LightSumPiece, HoldsItsBoundOver4096Terms) {
    // Plain addition: each term costs half a unit of the total, 4095 of them at worst. The others are there
    // to do better.
    const double tolerance = GetParam().name == "plain" ? (kTerms - 1) * 0x1p-24 : 1e-6;
    for (const Series& series : all_series())
        for (const sanitize::Machine machine : sanitize::kMachines)
            EXPECT_LE(relative_error(GetParam(), series, machine), tolerance)
                << series.name << ", " << sanitize::name_of(machine);
}

/// What the case is about: the plain sum is off by 4e-5.
TEST(LightSum, OfPlainAdditionsIsOff) {
    for (const SumPiece& piece : sum_pieces()) {
        if (piece.name != "plain") continue;
        EXPECT_GT(relative_error(piece, all_series().front(), sanitize::Machine::ieee), 4e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Pieces, LightSumPiece, testing::ValuesIn(sum_pieces()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gobo
