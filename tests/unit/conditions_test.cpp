// What the preprocessor's conditions leave in.
#include "compose/conditions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_families.hpp"

namespace gobo {
namespace {

/// Whether what follows a condition may be compiled: "yes", "no", or "perhaps" where only the driver knows.
std::string answer(
    const std::string& definitions, const std::string& condition,
    const std::string& prologue = "#version 450 core\n#define POINTS 3\n#define BLOCK(a, b) a b\n") {
    const ScannedPiece piece = scan_piece(definitions + condition + "\n#endif\n", "a.glsl").value();
    Conditions conditions(prologue);
    for (std::size_t i = 0; i + 1 < piece.directives.size(); ++i) {
        const Result<void> applied = conditions.apply(piece.directives[i]);
        if (!applied) return first_text(applied.error());
    }
    return !conditions.is_active() ? "no" : conditions.is_certain() ? "yes" : "perhaps";
}

struct ConditionRow {
    const char* name;
    const char* definitions;
    const char* condition;
    const char* answer;
};

class Condition : public testing::TestWithParam<ConditionRow> {};

TEST_P(Condition, IsAnswered) {
    EXPECT_EQ(answer(GetParam().definitions, GetParam().condition), GetParam().answer);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, Condition,
    testing::Values(
        ConditionRow{"feature_macro", "", "#if POINTS > 2", "yes"},
        ConditionRow{"feature_macro_too_small", "", "#if POINTS > 3", "no"},
        ConditionRow{"feature_macro_defined", "", "#ifdef POINTS", "yes"},
        ConditionRow{"dialect_macro_defined", "", "#ifndef BLOCK", "no"},
        ConditionRow{"version", "", "#if __VERSION__ >= 330 && __VERSION__ < 460", "yes"},
        ConditionRow{"es", "", "#ifdef GL_ES", "no"}, ConditionRow{"es_as_a_number", "", "#if GL_ES", "no"},
        ConditionRow{"core_profile", "", "#ifdef GL_core_profile", "yes"},
        ConditionRow{"undefined_is_zero", "", "#if NOTHING", "no"},
        ConditionRow{"defined_with_brackets", "#define A\n", "#if defined(A) && !defined ( B )", "yes"},
        ConditionRow{"defined_without", "#define A\n", "#if defined A && !defined B", "yes"},
        ConditionRow{"undefined_again", "#define A\n#undef A\n", "#ifdef A", "no"},
        ConditionRow{"never_defined", "#undef A\n", "#ifdef A", "no"},
        ConditionRow{"empty_definition", "#define A\n", "#if A", "perhaps"},
        ConditionRow{"arithmetic", "", "#if (1 + 2 * 3 - 4 / 2 == 5) && (7 % 4 == 3) && 1 << 4 == 16", "yes"},
        ConditionRow{"bits", "", "#if (6 & 3 | 8 ^ 1) == 11 && ~0 == -1 && 16 >> 2 == 4", "yes"},
        ConditionRow{"signs", "", "#if - -1 == +1 && !!2 == 1 && !0", "yes"},
        ConditionRow{"bases", "", "#if 0x10 == 16 && 010 == 8 && 3u == 3 && 0 == 00", "yes"},
        ConditionRow{"precedence", "", "#if 1 || 0 && 0", "yes"},
        ConditionRow{"comparisons", "", "#if 1 < 2 == 1 && 2 >= 2 && 1 <= 2 && 1 != 2", "yes"},
        ConditionRow{"not_reached", "", "#if 0 && 1 / 0", "no"},
        ConditionRow{"divided_by_zero", "", "#if 1 / 0", "perhaps"},
        ConditionRow{"rest_by_zero", "", "#if 1 % 0", "perhaps"},
        ConditionRow{"least_by_minus_one", "", "#if (-9223372036854775807 - 1) / -1", "yes"},
        ConditionRow{"least_rest", "", "#if (-9223372036854775807 - 1) % -1", "no"},
        ConditionRow{"overflow", "", "#if 9223372036854775807 + 1 < 0", "yes"},
        ConditionRow{"shifted_too_far", "", "#if 1 << 64", "perhaps"},
        ConditionRow{"no_number", "", "#if 1.5", "perhaps"},
        ConditionRow{"number_too_large", "", "#if 99999999999999999999", "perhaps"},
        ConditionRow{"no_expression", "", "#if (1", "perhaps"},
        ConditionRow{"nothing_at_all", "", "#if", "perhaps"},
        ConditionRow{"two_expressions", "", "#if 1 1", "perhaps"},
        ConditionRow{"object_like", "#define A B + 1\n#define B 2\n", "#if A == 3", "yes"},
        ConditionRow{"function_like",
                     "#define MAX(a, b) ((a) > (b) ? 1 : 0)\n#define AT_LEAST(a,b) ((a) >= (b))\n",
                     "#if AT_LEAST(__VERSION__, 330)", "yes"},
        ConditionRow{"function_like_nested", "#define ADD(a, b) a + b\n", "#if ADD(ADD(1, 2), (3)) == 6",
                     "yes"},
        ConditionRow{"function_like_without_arguments", "#define ONE() 1\n", "#if ONE()", "yes"},
        ConditionRow{"function_like_not_called", "#define ONE() 1\n", "#if ONE", "no"},
        ConditionRow{"function_like_left_open", "#define ONE(a) a\n", "#if ONE(1", "yes"},
        ConditionRow{"of_itself", "#define A A + 1\n", "#if A == 1", "yes"},
        ConditionRow{"of_one_another", "#define A B\n#define B A\n", "#if A == 0", "yes"},
        ConditionRow{"extension", "", "#ifdef GL_ARB_texture_gather", "perhaps"},
        ConditionRow{"extension_lacking", "", "#ifndef GL_ARB_texture_gather", "perhaps"},
        ConditionRow{"extension_or_certain", "", "#if defined(GL_ARB_texture_gather) || 1", "yes"},
        ConditionRow{"extension_and_not", "", "#if defined(GL_ARB_texture_gather) && 0", "no"},
        ConditionRow{"what_glslang_alone_has", "", "#ifdef GL_SPIRV", "no"},
        ConditionRow{"what_glslang_alone_has_as_a_number", "", "#if GL_SPIRV >= 100", "no"},
        ConditionRow{"extension_of_vulkan", "", "#if defined(GL_EXT_samplerless_texture_functions)", "no"},
        ConditionRow{"extension_of_tools", "", "#ifndef GL_GOOGLE_include_directive", "yes"},
        ConditionRow{"subgroups_which_opengl_may_have", "", "#ifdef GL_KHR_shader_subgroup_basic", "perhaps"},
        ConditionRow{"extension_else", "#ifdef GL_ARB_texture_gather\n#else\n", "#if 1\n#endif", "perhaps"},
        ConditionRow{"defined_by_an_extension", "#ifdef GL_OES_a\n#define A 1\n#endif\n", "#if A", "perhaps"},
        ConditionRow{"undefined_by_an_extension", "#define A 1\n#ifdef GL_OES_a\n#undef A\n#endif\n",
                     "#ifdef A", "perhaps"},
        ConditionRow{"own_name_of_that_kind", "#define GL_mine 0\n", "#if GL_mine", "no"},
        ConditionRow{"first_branch_that_holds",
                     "#if 0\n#elif 1\n#define A 1\n#elif 1\n#define A 2\n#else\n#define A 3\n#endif\n",
                     "#if A == 1", "yes"},
        ConditionRow{"else_branch", "#if 0\n#elif 0\n#else\n#define A\n#endif\n", "#ifdef A", "yes"},
        ConditionRow{"branch_within_a_dead_one",
                     "#if 0\n#if 1\n#define A\n#else\n#define A\n#endif\n#endif\n", "#ifdef A", "no"},
        ConditionRow{"dead_condition_that_is_none", "#if 0\n#if (\n#endif\n#endif\n", "#if 1", "yes"},
        ConditionRow{"elif_behind_the_taken_one", "#if 1\n#elif (\n#endif\n", "#if 1", "yes"}),
    [](const auto& row) { return row.param.name; });

TEST(Conditions, LeaveGlslangsMacrosToItForSpirv) {
    Conditions conditions("#version 450\n", false);
    EXPECT_FALSE(conditions.is_defined("GL_SPIRV").has_value());
    EXPECT_FALSE(conditions.is_defined("GL_EXT_samplerless_texture_functions").has_value());
}

TEST(Conditions, KnowEsProfiles) {
    EXPECT_EQ(answer("", "#if GL_ES && __VERSION__ == 300", "#version 300 es\n"), "yes");
    EXPECT_EQ(answer("", "#if defined GL_ES && __VERSION__ == 100", "#version 100\n"), "yes");
    EXPECT_EQ(answer("", "#ifdef GL_core_profile", "#version 300 es\n"), "no");
    EXPECT_EQ(answer("", "#ifdef GL_compatibility_profile", "#version 450 compatibility\n"), "yes");
    EXPECT_EQ(answer("", "#if __VERSION__ == 110", "#version 110\n"), "yes");
}

TEST(Conditions, RefuseMacrosWithoutEnd) {
    const char* const refused =
        "error: the macros of this condition expand to more than 20000 tokens\n    #if A16\n    ^\n"
        "  help: define them more simply\n";
    std::string doubling = "#define A0 1\n";
    std::string calls = "#define A0(x) x x\n";
    std::string chain = "#define A0 1\n";
    for (int i = 1; i <= 16; ++i) {
        const std::string name = "A" + std::to_string(i);
        const std::string last = "A" + std::to_string(i - 1);
        doubling += "#define " + name + " " + last + " + " + last + "\n";
        if (i <= 4)  // 65,536 tokens; what grows more is refused where it is defined
            calls += "#define " + name + "(x) " + last + "(" + last + "(x))\n";
    }
    for (int i = 1; i <= 5000; ++i)
        chain += "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + "\n";
    EXPECT_THAT(answer(doubling, "#if A16"), testing::EndsWith(refused));
    EXPECT_THAT(answer(calls, "#if A4(1)"), testing::HasSubstr("more than 20000 tokens"));
    EXPECT_THAT(answer(chain, "#if A5000"), testing::HasSubstr("more than 20000 tokens"));
    EXPECT_EQ(answer(chain, "#if A40"), "yes");
}

TEST(Conditions, TakeLongAndDeepOnes) {
    EXPECT_EQ(answer("", "#if " + std::string(1'001, '!') + "0"), "yes");
    std::string sum = "#if 0";
    for (int i = 0; i < 1000; ++i) sum += " + 1";
    EXPECT_EQ(answer("", sum + " == 1000"), "yes");
    EXPECT_EQ(answer("", "#if " + std::string(150, '(') + "1" + std::string(150, ')')), "perhaps");
}

}  // namespace
}  // namespace gobo
