// Outputs are held to their bounds: the declared domain of any family, and what the models of `lit` allow.
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sanitize_lit.hpp"
#include "sanitize_support.hpp"

namespace gobo {
namespace {

using Messages = std::vector<std::string>;

const std::string kLight = "vec4(max(cosine, 0.0) * strength)";

std::string shader_writing(const std::string& value) {
    return "#version 450\n"
           "layout(location = 0) in float cosine;\n"
           "uniform float strength;\n"
           "layout(location = 0) out vec4 color;\n"
           "void main() { color = " +
           value + "; }\n";
}

Lines found_within(const std::vector<Domain>& domains, const std::string& value) {
    return found_lines(sanitized_text("bounds.frag", shader_writing(value), {}, domains));
}

TEST(DeclaredBounds, HoldOutputsToTheirDomain) {
    const std::vector<Domain> narrow = {domain("cosine", -1, 1), domain("strength", 0, 2),
                                        domain("color", 0, 1)};
    EXPECT_EQ(found_within(narrow, kLight), Lines{"5: the output 'color' is above what its inputs allow"});
    EXPECT_EQ(found_within(narrow, "vec4(min(cosine, 0.5))"), Lines{"5: the output 'color' is negative"});
    EXPECT_EQ(found_within(narrow, "min(" + kLight + ", 1.0)"), Lines{});
}

TEST(DeclaredBounds, AreAllThatIsFiniteWhereNoneIsDeclared) {
    EXPECT_EQ(found_within({}, kLight), Lines{});
    EXPECT_EQ(found_within({}, "vec4(uintBitsToFloat(0x7f800000u))"),
              Lines{"5: the output 'color' is infinite"});
}

TEST(DeclaredBounds, AreNotAskedWhereATrapMadeTheOutput) {
    EXPECT_EQ(found_within({domain("color", 0, 1)}, "vec4(clamp(1.0 / cosine, 0.0, 1.0))"),
              Lines{"5: division by zero"});
}

/// gl_FragCoord.z is 0 to a machine that flushes, and what is written then is no broken promise.
TEST(DepthPromise, IsKeptWhereDenormalNumbersAreFlushed) {
    const std::string unchanged =
        "#version 450\n"
        "layout(depth_unchanged) out float gl_FragDepth;\n"
        "void main() { gl_FragDepth = gl_FragCoord.z; }\n";
    const Domain denormal = domain("gl_FragCoord", 0, 1e-40);
    EXPECT_EQ(found_lines(sanitized_text("depth.frag", unchanged, {}, {denormal})), Lines{});
}

TEST(DepthPromise, IsNamedWhereItIsBroken) {
    for (const std::string promise : {"depth_less", "depth_unchanged"})
        EXPECT_EQ(
            found_lines(sanitized_text("depth.frag",
                                       "#version 450\nin float push;\nlayout(" + promise +
                                           ") out float gl_FragDepth;\nvoid main() {\n"
                                           "gl_FragDepth = clamp(gl_FragCoord.z + push, 0.0, 1.0);\n}\n",
                                       {}, {})),
            Lines{"5: the output 'gl_FragDepth' breaks " + promise});
}

/// A piece of `lit` with a fault that traps nowhere.
struct Fault {
    std::string name;
    std::string key;
    std::string piece;
    std::string from;
    std::string to;
    std::string found;  ///< part of the finding's message
};

std::ostream& operator<<(std::ostream& stream, const Fault& fault) {
    return stream << fault.name;
}

const Fault kFaults[] = {
    {"highlight_too_bright", "directional=1 specular=blinn", "power/exact.glsl", "return exp(",
     "return 1.5 * exp(", "is above what its inputs allow"},
    {"light_behind_subtracts", "point=1", "diffuse/lambert.glsl", "return cosine", "return cosine - 0.5",
     "'fragmentColor' is negative"},
    {"fog_adds", "fog=exponential", "fog/blend.glsl", "mix(fog.color, radiance, fogFactor)",
     "2.0 * fog.color + radiance", "is above what its inputs allow"},
    {"vertex_light_too_bright", "directional=1 shading=vertex", "lighting/ambient.glsl", "return ",
     "return 1.1 * ", "'litRadiance' is above what its inputs allow"},
    {"depth_beyond_one", "depth=any", "depth/any.glsl", "min(moved, 1.0)", "min(moved, 1.5)",
     "'gl_FragDepth' is above what its inputs allow"},
    {"depth_promise_broken", "depth=greater", "depth/greater.glsl",
     "depthOffset.offset > 0.0 ? depthOffset.offset : 0.0", "depthOffset.offset",
     "'gl_FragDepth' breaks depth_greater"},
};

class FaultyLit : public testing::TestWithParam<Fault> {};

TEST_P(FaultyLit, LeavesItsBounds) {
    const sanitize::SanitizeReport sound = sanitized_lit(GetParam().key, {}, {});
    EXPECT_EQ(messages_of(sound), Messages{});
    const sanitize::SanitizeReport faulty =
        sanitized_lit(GetParam().key, {}, {GetParam().piece, GetParam().from, GetParam().to});
    ASSERT_FALSE(faulty.findings.empty());
    EXPECT_THAT(messages_of(faulty), testing::Contains(testing::HasSubstr(GetParam().found)));
}

INSTANTIATE_TEST_SUITE_P(Pieces, FaultyLit, testing::ValuesIn(kFaults), row_name);

/// GLSL allows exp() three roundings even at 0: an exponential above 1 takes away more fog than there is.
TEST(ModelBounds, HoldOnTheLeastAccurateMachines) {
    for (const char* key : {"fog=exponential", "fog=exponential_squared", "point=1 specular=phong"}) {
        sanitize::SanitizeOptions options;
        options.machines = {sanitize::Machine::errors_up, sanitize::Machine::errors_down};
        EXPECT_EQ(messages_of(sanitized_lit(key, options, {})), Messages{}) << key;
    }
    sanitize::SanitizeOptions options;
    options.machines = {sanitize::Machine::errors_up};
    const sanitize::SanitizeReport unguarded =
        sanitized_lit("fog=exponential", options, {"fog/exponential.glsl", ", 1.0)", ", 2.0)"});
    ASSERT_FALSE(unguarded.findings.empty());
    EXPECT_EQ(unguarded.findings.front().finding.message, "the output 'fragmentColor' is negative");
}

}  // namespace
}  // namespace gobo
