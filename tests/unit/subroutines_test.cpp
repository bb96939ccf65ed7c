// Subroutines of GLSL 4.00 as plain functions.
#include "compose/subroutines.hpp"

#include <gtest/gtest.h>

namespace gobo {
namespace {

TEST(Subroutines, AreFoundWithTheirFunctions) {
    const auto uniforms = subroutine_uniforms(
        "subroutine vec4 Shade();\nsubroutine float Fog(float d);\n"
        "layout(location = 1) subroutine uniform Shade shade;\nsubroutine uniform Fog fog;\n"
        "subroutine(Shade) vec4 white() { return vec4(1.0); }\n"
        "layout(index = 1) subroutine ( Fog, Glow ) float thick(float d) { return d; }\n"
        "subroutine(Shade) vec4 black() { return vec4(0.0); }\n");
    ASSERT_EQ(uniforms.size(), 2U);
    EXPECT_EQ(uniforms[0].name, "shade");
    EXPECT_EQ(uniforms[0].functions, (std::vector<std::string>{"white", "black"}));
    EXPECT_EQ(uniforms[1].name, "fog");
    EXPECT_EQ(uniforms[1].functions, (std::vector<std::string>{"thick"}));
    const auto pair = subroutine_uniforms("subroutine uniform Shade front,\n    back;\n");
    ASSERT_EQ(pair.size(), 2U);
    EXPECT_EQ(pair[1].name, "back");
    EXPECT_EQ(pair[1].type, "Shade");
    EXPECT_EQ(pair[0].line, 2);
    EXPECT_TRUE(subroutine_uniforms("uniform vec4 subroutines;\n").empty());
}

struct TypeRow {
    const char* name;
    const char* type;
    const char* expected;  ///< the function that calls another
};

TEST(Subroutines, BecomeFunctionsThatCallTheChosenOne) {
    const TypeRow rows[] = {
        {"nothing", "subroutine void Shade(void);", "void shade() { toon(); }"},
        {"unnamed", "subroutine vec4 Shade(vec3, float);",
         "vec4 shade(vec3 argument_0, float argument_1) { return toon(argument_0, argument_1); }"},
        {"parameter_named_as_the_function", "subroutine vec4 Shade(vec3 toon);",
         "vec4 shade(vec3 argument_0) { return toon(argument_0); }"},
        {"qualified", "subroutine highp float Shade(const in vec3 n, inout mediump float sum);",
         "highp float shade(const in vec3 argument_0, inout mediump float argument_1) { return "
         "toon(argument_0, argument_1); }"},
        {"arrays", "subroutine vec4 Shade(vec3 n[2], float[N] weights, float[N]);",
         "vec4 shade(vec3 argument_0[ 2 ], float [ N ] argument_1, float [ N ] argument_2) { return "
         "toon(argument_0, argument_1, argument_2); }"},
    };
    for (const TypeRow& row : rows) {
        SCOPED_TRACE(row.name);
        const std::vector<SubroutineType> types = subroutine_types(row.type);
        ASSERT_EQ(types.size(), 1U);
        EXPECT_EQ(types[0].name, "Shade");
        EXPECT_EQ(call_of({"shade", "Shade", {}}, types[0], "toon"), row.expected);
    }
}

struct Row {
    const char* name;
    const char* code;
    const char* expected;  ///< the same places, blanked
};

TEST(Subroutines, LeavePlainFunctionsAtTheirPlaces) {
    const Row rows[] = {
        {"type", "subroutine vec4 Shade();\n", "           vec4 Shade();\n"},
        {"uniform", "subroutine uniform Shade\n    shade;\n", "                        \n          \n"},
        {"uniform_at_a_location", "layout(location = 1) subroutine uniform Shade shade; float x;\n",
         "                                                     float x;\n"},
        {"function", "subroutine (Shade)\nvec4 white() { return vec4(1.0); }\n",
         "                  \nvec4 white() { return vec4(1.0); }\n"},
        {"function_with_an_index", "layout(index = 2) subroutine(Shade) vec4 white() { }\n",
         "                                    vec4 white() { }\n"},
        {"another_uniform", "subroutine uniform Fog fog;\nsubroutine(Fog) float thick() { }\n",
         "subroutine uniform Fog fog;\nsubroutine(Fog) float thick() { }\n"},
        {"no_end", "subroutine uniform Shade shade", "                              "},
        {"nothing_behind", "subroutine", "          "},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.name);
        std::string text = row.code;
        std::string code = row.code;
        choose_subroutines(text, code, {"shade"});
        EXPECT_EQ(code, row.expected);
        EXPECT_EQ(text, row.expected);
    }
    std::string text = "subroutine(Shade) /* red */ vec4 red();\n";
    std::string code = "subroutine(Shade)           vec4 red();\n";
    choose_subroutines(text, code, {"shade"});
    EXPECT_EQ(text, "                  /* red */ vec4 red();\n") << "comments stay";
    choose_subroutines(text, code, {});
}

}  // namespace
}  // namespace gobo
