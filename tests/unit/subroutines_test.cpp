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
    EXPECT_TRUE(subroutine_uniforms("uniform vec4 subroutines;\n").empty());
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
