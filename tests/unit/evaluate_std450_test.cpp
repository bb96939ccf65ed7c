// Every function of GLSL.std.450 and every operator of reals, against the C++ library and GLM in double.
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

using Vector = glm::dvec4;

struct Case {
    const char* name;
    const char* expression;  ///< of a, b, c: a vec4
    std::function<Vector(Vector a, Vector b, Vector c)> expected;
};

Vector each(const std::function<double(double)>& function, Vector a) {
    return {function(a.x), function(a.y), function(a.z), function(a.w)};
}
Vector each(const std::function<double(double, double)>& function, Vector a, Vector b) {
    return {function(a.x, b.x), function(a.y, b.y), function(a.z, b.z), function(a.w, b.w)};
}

using V = Vector;
const Case kCases[] = {
    {"negate", "-a", [](V a, V, V) { return -a; }},
    {"add", "a + b", [](V a, V b, V) { return a + b; }},
    {"subtract", "a - b", [](V a, V b, V) { return a - b; }},
    {"multiply", "a * b", [](V a, V b, V) { return a * b; }},
    {"divide", "a / b", [](V a, V b, V) { return a / b; }},
    {"scale", "a * b.x", [](V a, V b, V) { return a * b.x; }},
    {"mod", "mod(a, c)", [](V a, V, V c) { return glm::mod(a, c); }},
    {"round", "round(a * 3.0)", [](V a, V, V) { return glm::round(a * 3.0); }},
    {"round_even", "roundEven(vec4(0.5, 1.5, -2.5, 2.75))", [](V, V, V) { return V(0, 2, -2, 3); }},
    {"trunc", "trunc(a * 3.0)", [](V a, V, V) { return glm::trunc(a * 3.0); }},
    {"floor", "floor(a * 3.0)", [](V a, V, V) { return glm::floor(a * 3.0); }},
    {"ceil", "ceil(a * 3.0)", [](V a, V, V) { return glm::ceil(a * 3.0); }},
    {"fract", "fract(a * 3.0)", [](V a, V, V) { return glm::fract(a * 3.0); }},
    {"abs", "abs(a)", [](V a, V, V) { return glm::abs(a); }},
    {"sign", "sign(a)", [](V a, V, V) { return glm::sign(a); }},
    {"min", "min(a, b)", [](V a, V b, V) { return glm::min(a, b); }},
    {"max", "max(a, b)", [](V a, V b, V) { return glm::max(a, b); }},
    {"clamp", "clamp(a, -0.25, 0.5)", [](V a, V, V) { return glm::clamp(a, -0.25, 0.5); }},
    {"mix", "mix(a, b, c)", [](V a, V b, V c) { return glm::mix(a, b, c); }},
    {"mix_by_truth", "mix(a, b, lessThan(a, b))", [](V a, V b, V) { return glm::max(a, b); }},
    {"step", "step(a, b)", [](V a, V b, V) { return glm::step(a, b); }},
    {"smoothstep", "smoothstep(vec4(-0.5), vec4(1.0), a)",
     [](V a, V, V) { return glm::smoothstep(V(-0.5), V(1), a); }},
    {"fma", "fma(a, b, c)", [](V a, V b, V c) { return a * b + c; }},
    {"ldexp", "ldexp(a, ivec4(1, -2, 3, 0))", [](V a, V, V) { return V(a.x * 2, a.y / 4, a.z * 8, a.w); }},
    {"sqrt", "sqrt(c)", [](V, V, V c) { return glm::sqrt(c); }},
    {"inversesqrt", "inversesqrt(c)", [](V, V, V c) { return 1.0 / glm::sqrt(c); }},
    {"pow", "pow(c, b)",
     [](V, V b, V c) { return each([](double x, double y) { return std::pow(x, y); }, c, b); }},
    {"exp", "exp(a)", [](V a, V, V) { return glm::exp(a); }},
    {"exp2", "exp2(a)", [](V a, V, V) { return each([](double x) { return std::exp2(x); }, a); }},
    {"log", "log(c)", [](V, V, V c) { return glm::log(c); }},
    {"log2", "log2(c)", [](V, V, V c) { return each([](double x) { return std::log2(x); }, c); }},
    {"radians", "radians(a)", [](V a, V, V) { return a * std::numbers::pi / 180.0; }},
    {"degrees", "degrees(a)", [](V a, V, V) { return a * 180.0 / std::numbers::pi; }},
    {"sin", "sin(a)", [](V a, V, V) { return glm::sin(a); }},
    {"cos", "cos(a)", [](V a, V, V) { return glm::cos(a); }},
    {"tan", "tan(a)", [](V a, V, V) { return glm::tan(a); }},
    {"asin", "asin(c / 4.0)", [](V, V, V c) { return glm::asin(c / 4.0); }},
    {"acos", "acos(c / 4.0)", [](V, V, V c) { return glm::acos(c / 4.0); }},
    {"atan", "atan(a)", [](V a, V, V) { return glm::atan(a); }},
    {"atan2", "atan(a, b)",
     [](V a, V b, V) { return each([](double y, double x) { return std::atan2(y, x); }, a, b); }},
    {"sinh", "sinh(a)", [](V a, V, V) { return each([](double x) { return std::sinh(x); }, a); }},
    {"cosh", "cosh(a)", [](V a, V, V) { return each([](double x) { return std::cosh(x); }, a); }},
    {"tanh", "tanh(a)", [](V a, V, V) { return each([](double x) { return std::tanh(x); }, a); }},
    {"asinh", "asinh(a)", [](V a, V, V) { return each([](double x) { return std::asinh(x); }, a); }},
    {"acosh", "acosh(c + 1.0)",
     [](V, V, V c) { return each([](double x) { return std::acosh(x + 1.0); }, c); }},
    {"atanh", "atanh(c / 4.0)",
     [](V, V, V c) { return each([](double x) { return std::atanh(x / 4.0); }, c); }},
    {"length", "vec4(length(a.xyz))", [](V a, V, V) { return V(glm::length(glm::dvec3(a))); }},
    {"distance", "vec4(distance(a, b))", [](V a, V b, V) { return V(glm::distance(a, b)); }},
    {"dot", "vec4(dot(a, b))", [](V a, V b, V) { return V(glm::dot(a, b)); }},
    {"cross", "vec4(cross(a.xyz, b.xyz), 0.0)",
     [](V a, V b, V) { return V(glm::cross(glm::dvec3(a), glm::dvec3(b)), 0.0); }},
    {"normalize", "normalize(a)", [](V a, V, V) { return glm::normalize(a); }},
    {"faceforward", "faceforward(a, b, c)", [](V a, V b, V c) { return glm::faceforward(a, b, c); }},
    {"reflect", "reflect(a, normalize(b))", [](V a, V b, V) { return glm::reflect(a, glm::normalize(b)); }},
    {"refract", "refract(normalize(a), normalize(b), 0.75)",
     [](V a, V b, V) { return glm::refract(glm::normalize(a), glm::normalize(b), 0.75); }},
    {"refract_totally", "refract(normalize(a), normalize(b), 4.0)", [](V, V, V) { return V(0); }},
    {"isnan", "vec4(isnan(vec4(a.x, sqrt(-c.x), c.y / 0.0, 1.0)))", [](V, V, V) { return V(0, 1, 0, 0); }},
    {"isinf", "vec4(isinf(vec4(a.x, sqrt(-c.x), c.y / 0.0, 1.0)))", [](V, V, V) { return V(0, 0, 1, 0); }},
};

class Std450 : public ::testing::TestWithParam<Case> {};

const V kA(0.75, -1.25, 0.3, 2.0);
const V kB(0.5, 1.75, -0.4, 0.25);
const V kC(0.6, 1.5, 2.25, 3.0);

std::map<std::string, std::vector<double>, std::less<>> inputs() {
    const auto list = [](V v) { return std::vector<double>{v.x, v.y, v.z, v.w}; };
    return {{"a", list(kA)}, {"b", list(kB)}, {"c", list(kC)}};
}

/// The larger of 1 and the size of the expected value: errors are relative above 1.
double scale_of(double expected) {
    return std::max(1.0, std::fabs(expected));
}

TEST_P(Std450, IsWhatTheLibraryGivesInDouble) {
    const Program program = fragment_of(std::string("r = ") + GetParam().expression + ";");
    const std::vector<double> r = output_of<double>(program, inputs());
    const V expected = GetParam().expected(kA, kB, kC);
    ASSERT_EQ(r.size(), 4U);
    // A few roundings of fp64 apart: the same formula may be written in another order.
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(r[static_cast<std::size_t>(i)], expected[i], 8 * 0x1p-52 * scale_of(expected[i])) << i;
}

TEST_P(Std450, IsNearItInFloat) {
    const Program program = fragment_of(std::string("r = ") + GetParam().expression + ";");
    const std::vector<double> r = output_of<float>(program, inputs());
    const V expected = GetParam().expected(kA, kB, kC);
    ASSERT_EQ(r.size(), 4U);
    // The inputs are rounded to fp32 (2^-24 relative), which the steepest function here magnifies some 8
    // times.
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(r[static_cast<std::size_t>(i)], expected[i], 16 * 0x1p-24 * scale_of(expected[i])) << i;
}

INSTANTIATE_TEST_SUITE_P(Functions, Std450, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace gobo::evaluate
