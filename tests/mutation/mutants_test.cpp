// That mutants change what they say, and leave alone what is no code.
#include "mutants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gobo {
namespace {

std::vector<std::string> mutated_lines(std::string_view text) {
    std::vector<std::string> lines;
    for (const Mutant& mutant : mutants_of("piece.glsl", text)) lines.push_back(mutant.mutated_line);
    return lines;
}

TEST(Mutants, ChangeOneOperatorOrConstantAtATime) {
    using testing::ElementsAre;
    EXPECT_THAT(mutated_lines("x = a + b * c;"), ElementsAre("x = a - b * c;", "x = a + b / c;"));
    EXPECT_THAT(mutated_lines("x -= a;\n  y += 0.5;"), ElementsAre("x += a;", "y -= 0.5;", "y += 0.75;"));
    EXPECT_THAT(mutated_lines("if (a <= 0.0) b2 = vec3(1e-30);"),
                ElementsAre("if (a > 0.0) b2 = vec3(1e-30);", "if (a <= 1.0) b2 = vec3(1e-30);",
                            "if (a <= 0.0) b2 = vec3(1.5000000000000001e-30);"));
    EXPECT_THAT(mutated_lines("x = min(a, xmin(b));"), ElementsAre("x = max(a, xmin(b));"));
    EXPECT_THAT(mutated_lines("for (int i = 0; i < N; ++i) {}"),
                ElementsAre("for (int i = 1; i < N; ++i) {}", "for (int i = 0; i >= N; ++i) {}"));
}

TEST(Mutants, LeaveCommentsAndDeclarationsAlone) {
    EXPECT_TRUE(
        mutants_of("piece.glsl", "// a + b\n#if N > 0\nBLOCK(3, Fog) {\nATTRIBUTE(1) vec3 n;\n").empty());
    EXPECT_EQ(mutated_lines("x = a;  // b + c"), std::vector<std::string>{});
}

TEST(Mutants, HoldTheWholePieceAndSayWhere) {
    const std::vector<Mutant> mutants = mutants_of("fog/a.glsl", "// first\nfloat x = 2.0;  // second\n");
    ASSERT_EQ(mutants.size(), 1U);
    EXPECT_EQ(mutants[0].text, "// first\nfloat x = 3.0;  // second\n");
    EXPECT_EQ(mutants[0].line, 2);
    EXPECT_EQ(mutants[0].change, "2.0 to 3.0");
    EXPECT_EQ(mutants[0].piece, "fog/a.glsl");
}

}  // namespace
}  // namespace gobo
