// Families without an oracle: fp32 against fp64.
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/read_family.hpp"
#include "lab/verify/verify.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// Verifies a family of one key whose fragment stage computes `expression` of `vec3 v` and `float range`.
verify::VerifyReport verify_expression(const std::string& expression) {
    const MemoryFileSystem files(
        {{"own/own.vert",
          "#version 450\nlayout(location = 0) in vec3 position;\nlayout(location = 0) out "
          "vec3 v;\nvoid main() { v = position; gl_Position = vec4(position, 1.0); }\n"},
         {"own/own.frag",
          "#version 450\nlayout(location = 0) in vec3 v;\nlayout(location = 0) out float "
          "result;\nlayout(std140, binding = 0) uniform Block { float range; };\n"
          "void main() { result = " +
              expression + "; }\n"}});
    const Family family =
        read_family(
            "name = 'own'\nvertex = 'own.vert'\nfragment = 'own.frag'\n[features.lut]\nrole = "
            "'effect'\ndefine = 'USE_LUT'\n[domain]\n'v' = [-10, 10]\n'Block.range' = [1, 100]\n",
            "own/own.toml")
            .value();
    SearchPath search;
    search.add(files, "own", "", false);
    const Composition composition =
        compose(family, {Key(family.features.size())}, search, Dialect::own).value();
    ValidateOptions options;
    options.keep_spirv = true;
    return verify::verify(family, composition, validate(family, composition, options), {});
}

struct Row {
    std::string name;
    std::string expression;
    bool is_fine;
};

TEST(Alone, FindsLostDigitsButNotConditionAndSteps) {
    const std::vector<Row> rows = {
        {"a length", "length(v) / range", true},
        {"an ill-conditioned function of a well computed argument", "exp(5.0 * v.x)", true},
        {"a step", "v.x > 0.5 * v.y ? 1.0 : 0.0", true},
        {"digits lost on the way", "((v.x + 1.0e6) - 1.0e6) / range", false},
        {"a square that overflows on the way", "sqrt(v.x * 1.0e30 * (v.x * 1.0e30)) / 1.0e30", false},
        {"a NaN in both, which is for the sanitizer to tell", "sqrt(v.x)", true},
        {"a NaN in fp32 alone", "0.0 * (v.x * 1.0e30 * 1.0e30)", false},
    };
    for (const Row& row : rows) {
        const verify::VerifyReport report = verify_expression(row.expression);
        EXPECT_EQ(report.without_oracle, 1U) << row.name;
        EXPECT_TRUE(report.permutations[0].diagnostics.empty()) << row.name;
        EXPECT_EQ(report.permutations[0].failed_points == 0, row.is_fine) << row.name;
    }
}

}  // namespace
}  // namespace gobo
