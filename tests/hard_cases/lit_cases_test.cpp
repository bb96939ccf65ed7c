// The hard cases of `lit`: at inputs where the textbook's formulas fail, every permutation that they concern
// gives what the case demands, with no undefined operation on the way. And each guard that this takes is
// needed: without it, the case it is there for fails.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lit_guards.hpp"
#include "pbr_guards.hpp"

namespace gobo {
namespace {

class TestedCase : public testing::TestWithParam<Case> {};

TEST_P(TestedCase, GivesWhatIsDemanded) {
    EXPECT_THAT(faults_of(GetParam()), testing::IsEmpty());
}

constexpr auto by_name = [](const auto& tested) { return tested.param.name; };

INSTANTIATE_TEST_SUITE_P(Lit, TestedCase, testing::ValuesIn(lit_cases()), by_name);
INSTANTIATE_TEST_SUITE_P(Pbr, TestedCase, testing::ValuesIn(pbr_cases()), by_name);

class TestedGuard : public testing::TestWithParam<Guard> {};

TEST_P(TestedGuard, IsNeeded) {
    const Guard& guard = GetParam();
    const Case* tested = case_named(guard.needed_by);
    ASSERT_NE(tested, nullptr) << guard.needed_by;
    EXPECT_THAT(faults_of(*tested, {{guard.piece, without_guard(guard)}}, 1),
                testing::Not(testing::IsEmpty()));
}

INSTANTIATE_TEST_SUITE_P(Lit, TestedGuard, testing::ValuesIn(lit_guards()), by_name);
INSTANTIATE_TEST_SUITE_P(Pbr, TestedGuard, testing::ValuesIn(pbr_guards()), by_name);

/// Nobody adds a guard without showing that it is needed.
TEST(LitGuards, EachMarkedLineHasARow) {
    for (const GuardMark& mark : guard_marks()) {
        const auto takes_away = [&](const Guard& guard) {
            return guard.piece == mark.piece && (mark.text.find(guard.guarded) != std::string::npos ||
                                                 mark.line_before.find(guard.guarded) != std::string::npos);
        };
        const auto holds_one = [&](const std::vector<Guard>& guards) {
            return std::any_of(guards.begin(), guards.end(), takes_away);
        };
        const bool has_row = holds_one(lit_guards()) || holds_one(pbr_guards());
        EXPECT_TRUE(has_row)
            << "shader_lib/" << mark.piece << ":" << mark.line << ": " << mark.text
            << "\n  is marked as a guard, but no row of tests/hard_cases/lit_guards.cpp "
               "or pbr_guards.cpp takes it away. Add\n    {\"some_name\", \""
            << mark.piece
            << "\", \"the guarded text\", \"the plain text\", \"a_case\"},\n  where the "
               "case, a row of lit_cases.cpp or pbr_guards.cpp, fails with the plain text in its place.";
    }
}

TEST(LitGuards, AMarkIsCodeWithACommentBehindIt) {
    const auto marks = guard_marks();
    EXPECT_GE(marks.size(), 20U);
    for (const GuardMark& mark : marks) EXPECT_EQ(mark.text.find("// Edges:"), std::string::npos);
}

}  // namespace
}  // namespace gobo
