// A finding's input is made simple: what does not matter is 0 or 1, what matters has few digits.
#include <cmath>

#include <gtest/gtest.h>

#include "sanitize_support.hpp"

namespace gobo {
namespace {

using Values = std::map<std::string, std::vector<double>>;

sanitize::Point point_of_only_finding(const std::string& text, const std::vector<Domain>& domains = {}) {
    const sanitize::SanitizeReport report = sanitized_text("shrink.frag", text, {}, domains);
    EXPECT_EQ(report.findings.size(), 1U);
    return report.findings.empty() ? sanitize::Point{} : report.findings.front().finding.point;
}

const std::string kHead =
    "#version 450\n"
    "layout(location = 0) in vec3 place;\n"
    "layout(location = 1) in float near;\n"
    "layout(location = 2) in float far;\n"
    "uniform mat3 turn;\n"
    "layout(location = 0) out vec4 color;\n";

TEST(Shrink, ClearsWhatDoesNotMatter) {
    const sanitize::Point point =
        point_of_only_finding(kHead + "void main() { color = vec4(turn * place, 1.0 / near); }\n");
    EXPECT_EQ(point.inputs, (Values{{"far", {0}}, {"near", {0}}, {"place", {0, 0, 0}}}));
    EXPECT_EQ(point.uniforms, (Values{{"turn", std::vector<double>(9, 0.0)}}));
}

TEST(Shrink, KeepsEqualWhatMustBeEqual) {
    const sanitize::Point point = point_of_only_finding(
        kHead + "void main() { color = vec4(near > 0.5 ? 1.0 / (far - near) : 0.0); }\n");
    EXPECT_EQ(point.inputs, (Values{{"far", {1}}, {"near", {1}}, {"place", {0, 0, 0}}}));
}

TEST(Shrink, RoundsToFewDigits) {
    const sanitize::Point point =
        point_of_only_finding(kHead + "void main() { color = vec4(sqrt(near - 50.0 + place.x * 0.0)); }\n");
    EXPECT_EQ(point.inputs, (Values{{"far", {0}}, {"near", {0}}, {"place", {0, 0, 0}}}));
    const sanitize::Point above = point_of_only_finding(
        kHead + "void main() { color = vec4(sqrt(near < 50.0 ? 1.0 : 50.0 - near)); }\n");
    ASSERT_EQ(above.inputs.at("near").size(), 1U);
    EXPECT_EQ(above.inputs.at("near").front() * 10, std::round(above.inputs.at("near").front() * 10));
}

TEST(Shrink, StaysWithinTheDomain) {
    Domain near;
    near.name = "near";
    near.low = 3;
    near.high = 90;
    const sanitize::Point point =
        point_of_only_finding(kHead + "void main() { color = vec4(sqrt(place.x - near)); }\n", {near});
    EXPECT_EQ(point.inputs, (Values{{"far", {0}}, {"near", {3}}, {"place", {0, 0, 0}}}));
}

}  // namespace
}  // namespace gobo
