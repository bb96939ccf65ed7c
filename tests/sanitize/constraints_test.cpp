// A stated contract between inputs silences what only breaking it reaches, and nothing else.
#include <ostream>

#include <gtest/gtest.h>

#include "lab/sanitize/input_space.hpp"
#include "sanitize_support.hpp"

namespace gobo {
namespace {

struct Row {
    std::string name;
    std::string statement;  ///< in line 8, a trap unless the contract holds
    std::string constraint;
    std::string message;  ///< of the trap
};

std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
}

const Row kRows[] = {
    {"less", "color.r = 1.0 / (far - near);", "near < far", "division by zero"},
    {"more", "color.r = 1.0 / (far - near);", "far > near", "division by zero"},
    {"at_most", "color.r = sqrt(far - near);", "near <= far", "sqrt() of a negative number"},
    {"at_least", "color.r = sqrt(far - near);", "far >= near", "sqrt() of a negative number"},
    {"different", "color.r = 1.0 / (far - near);", "near != far", "division by zero"},
    {"above_number", "color.r = log(near - 0.5);", "near > 0.5", "log() of a number not above 0"},
    {"at_least_number", "color.r = sqrt(near - 0.5);", "near >= 0.5", "sqrt() of a negative number"},
    {"below_number", "color.r = log(0.5 - near);", "near < 0.5", "log() of a number not above 0"},
    {"at_most_number", "color.r = sqrt(-2.0 - near);", "-2 >= near", "sqrt() of a negative number"},
    {"not_number", "color.r = 1.0 / near;", "near != 0", "division by zero"},
    {"less_smoothstep", "color.r = smoothstep(near, far, v.x);", "near < far",
     "smoothstep() with equal edges"},
    {"unit", "color.rgb = normalize(normal);", "unit(normal)", "normalize() of a zero vector"},
    {"unit_length", "color.r = log(length(normal) + 0.001);", "unit(normal)", ""},
    {"not_zero", "color.rgb = normalize(v);", "not_zero(v)", "normalize() of a zero vector"},
    {"distinct", "color.r = v == normal ? 1.0 / (v.x - normal.x) : 0.0;", "distinct(v, normal)",
     "division by zero"},
    {"distinct_of_two_sizes", "color.rgb = normalize(lamp.xyz - v);", "distinct(lamp, v)",
     "normalize() of a zero vector"},
    {"distinct_in_all_pixels", "color.rgb = normalize(directions[1] - v) + dFdx(v);",
     "distinct(directions[], v)", "normalize() of a zero vector"},
    {"orthonormal", "color.rgb = normalize(tbn * vec3(0.0, 0.0, 1.0));", "orthonormal(tbn)",
     "normalize() of a zero vector"},
    {"inverse_transpose", "color.rgb = normalize(normalMatrix * vec3(1.0, 0.0, 0.0));",
     "inverse_transpose_of(normalMatrix, modelView)", "normalize() of a zero vector"},
    {"component_and_number", "color.r = sqrt(v.y - 0.5);", "v.y >= 0.5", "sqrt() of a negative number"},
    {"component_is_not", "color.r = 1.0 / v.b;", "v.z != 0", "division by zero"},
    {"two_components", "color.r = sqrt(v.z - v.y);", "v.y <= v.z", "sqrt() of a negative number"},
    {"component_and_input", "color.r = 1.0 / (far - v.y);", "v.g < far", "division by zero"},
    {"component_of_elements", "color.r = log(directions[1].y);", "directions[].y > 0",
     "log() of a number not above 0"},
    {"of_elements", "color.rgb = normalize(directions[1]);", "unit(directions[])",
     "normalize() of a zero vector"},
};

std::string shader_with(const std::string& statement) {
    return "#version 450\n"
           "in vec3 v; in vec3 normal;\n"
           "uniform float near; uniform float far; uniform vec3 directions[2];\n"
           "uniform mat3 tbn; uniform mat3 normalMatrix; uniform mat4 modelView;\n"
           "out vec4 color;\n" +
           std::string(statement.find("lamp") == std::string::npos ? "" : "uniform vec4 lamp; ") +
           "void main() {\n"
           "    color = vec4(modelView[0].x * 1e-30 + normalMatrix[0].x * 1e-30);\n    " +
           statement + "\n}\n";
}

class Contract : public testing::TestWithParam<Row> {};

TEST_P(Contract, SilencesWhatItExcludes) {
    const std::string text = shader_with(GetParam().statement);
    const Lines without = found_lines(sanitized_text("contract.frag", text, {}));
    if (!GetParam().message.empty()) {
        EXPECT_TRUE(without.contains("8: " + GetParam().message)) << text;
    }
    EXPECT_EQ(
        found_lines(sanitized_text("contract.frag", text, {}, {plain_domain(GetParam().constraint, 0, 0)})),
        Lines{});
}

/// A hazard that the contract says nothing of is found as before, and its input keeps the contract.
TEST_P(Contract, LeavesWhatItSaysNothingOf) {
    const std::string text = shader_with(
        "color.r = 1.0 / v.x + 0.0 * (near + far + tbn[0].x + normal.x + "
        "directions[0].x + directions[1].x);");
    const auto report =
        sanitized_text("contract.frag", text, {}, {plain_domain(GetParam().constraint, 0, 0)});
    EXPECT_EQ(found_lines(report), Lines{"8: division by zero"});
    EXPECT_EQ(not_replayed("contract.frag", text, report), Lines{});
    const auto& point = report.findings.front().finding.point;
    if (GetParam().constraint == "near < far") {
        EXPECT_LT(point.uniforms.at("near").front(), point.uniforms.at("far").front());
    }
}

/// Constraints that no input within [-100, 100] keeps together.
TEST(Contracts, ThatContradictOneAnotherAreErrors) {
    const evaluate::Program program = program_of("contract.frag", shader_with("color.r = far - near;"));
    const auto contradiction = [&](const std::vector<std::string>& constraints) {
        std::vector<Domain> domains;
        for (const std::string& constraint : constraints) domains.push_back(plain_domain(constraint, 0, 0));
        const sanitize::InputSpace space = sanitize::input_space_of(program, domains, true);
        const Constraint* const found = sanitize::contradiction_in(space);
        return found == nullptr ? "" : found->text;
    };
    EXPECT_EQ(contradiction({"near <= far", "far <= near", "near != 0", "far > 0"}), "");
    const std::vector<std::vector<std::string>> contradictory = {{"near < far", "far < near"},
                                                                 {"near < far", "far <= near"},
                                                                 {"near > 200"},
                                                                 {"v.y > 200"},
                                                                 {"v.y < v.z", "v.z < v.y"},
                                                                 {"v.y < v.y"},
                                                                 {"near < near"},
                                                                 {"near != near"},
                                                                 {"near > 5", "far < 5", "near < far"}};
    for (const std::vector<std::string>& constraints : contradictory)
        EXPECT_NE(contradiction(constraints), "") << constraints.front();
}

/// What is neither a comparison nor one of the functions is none: it is refused by its text.
TEST(Contracts, OfAnotherFormAreNone) {
    for (const char* text : {"near == far", "near < far < 2", "2 * near < far", "1 < 2", "near <", "= far",
                             "abs(near) < 1", "unit(normal, v)", "unit(3)", "nonzero(v)", "near"})
        EXPECT_FALSE(constraint_of(text)) << text;
}

/// A component may have a range of its own: what only the others reach is found still.
TEST(DomainOfAComponent, IsKeptBesideThatOfTheWhole) {
    Domain whole;
    whole.name = "v";
    whole.low = -2;
    whole.high = 2;
    Domain second;
    second.name = "v.y";
    second.low = 0.25;
    second.high = 0.5;
    const std::string within = "color.r = sqrt(v.y - 0.25) + sqrt(0.5 - v.y) + sqrt(v.x + 2.0) ";
    EXPECT_EQ(found_lines(sanitized_text("contract.frag", shader_with(within + ";"), {}, {whole, second})),
              Lines{});
    for (const char* beyond : {"+ sqrt(v.y - 0.26);", "+ sqrt(0.49 - v.y);", "+ sqrt(1.9 - v.x);"})
        EXPECT_EQ(
            found_lines(sanitized_text("contract.frag", shader_with(within + beyond), {}, {whole, second})),
            Lines{"8: sqrt() of a negative number"})
            << beyond;
}

/// A matrix of neither zeros nor ones.
TEST(DomainOfAMatrix, HoldsForItsSpecialForms) {
    Domain domain;
    domain.name = "tbn";
    domain.low = 2;
    domain.high = 3;
    EXPECT_EQ(found_lines(sanitized_text("contract.frag",
                                         shader_with("color.r = 1.0 / tbn[1][2] + sqrt(tbn[0][0] - 2.0);"),
                                         {}, {domain})),
              Lines{});
}

INSTANTIATE_TEST_SUITE_P(Rows, Contract, testing::ValuesIn(kRows), row_name);

}  // namespace
}  // namespace gobo
