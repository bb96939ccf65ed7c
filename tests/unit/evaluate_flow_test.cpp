// Control flow where invocations go different ways: each lane must end as if it had run alone.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

struct Case {
    const char* name;
    const char* declarations;
    const char* body;  ///< reads `int n`, writes `float t`
    std::function<double(int n)> expected;
};

const Case kCases[] = {
    {"if_else", "", "if (n > 3) t = 1.0; else if (n == 2) t = 2.0; else t = 3.0;",
     [](int n) { return n > 3    ? 1.0
                        : n == 2 ? 2.0
                                 : 3.0; }},
    {"loop_of_each_length", "", "for (int i = 0; i < n; ++i) t += float(i);",
     [](int n) { return n * (n - 1) / 2.0; }},
    {"break_and_continue", "",
     "for (int i = 0; i < 20; ++i) { if (i == n) break; if (i % 2 == 0) continue; t += float(i); }",
     [](int n) {
         double t = 0;
         for (int i = 0; i < 20; ++i) {
             if (i == n) break;
             if (i % 2 == 0) continue;
             t += i;
         }
         return t;
     }},
    {"nested_loops", "",
     "for (int i = 0; i < n; ++i) { for (int j = 0; j < 9; ++j) { if (j > i) break; if ((i + j) % 3 == n % "
     "3) continue; "
     "t += float(i * 10 + j); } if (t > 300.0) break; }",
     [](int n) {
         double t = 0;
         for (int i = 0; i < n; ++i) {
             for (int j = 0; j < 9; ++j) {
                 if (j > i) break;
                 if ((i + j) % 3 == n % 3) continue;
                 t += i * 10 + j;
             }
             if (t > 300.0) break;
         }
         return t;
     }},
    {"do_while", "", "int i = 0; do { t += 2.0; ++i; } while (i < n);",
     [](int n) { return 2.0 * std::max(n, 1); }},
    {"while_with_two_ends", "",
     "int i = n; while (true) { if (i <= 0) break; t += 1.0; if (t > 5.0) break; --i; }",
     [](int n) { return std::min<double>(n, 6); }},
    {"early_return",
     "float f(int n) { if (n < 2) return 1.0; for (int i = 0; i < n; ++i) { if (i * i > n) return float(i); "
     "} return -1.0; }",
     "t = f(n) + f(n + 5);",
     [](int n) {
         const auto f = [](int m) {
             if (m < 2) return 1.0;
             for (int i = 0; i < m; ++i)
                 if (i * i > m) return static_cast<double>(i);
             return -1.0;
         };
         return f(n) + f(n + 5);
     }},
    {"switch_with_fallthrough", "",
     "switch (n % 6) { case 0: t += 1.0; case 1: t += 10.0; break; case 4: t += 100.0; case 2: t += 1000.0; "
     "default: t += 0.5; }",
     [](int n) {
         double t = 0;
         switch (n % 6) {
             case 0:
                 t += 1.0;
                 [[fallthrough]];
             case 1:
                 t += 10.0;
                 break;
             case 4:
                 t += 100.0;
                 [[fallthrough]];
             case 2:
                 t += 1000.0;
                 [[fallthrough]];
             default:
                 t += 0.5;
         }
         return t;
     }},
    {"switch_in_loop", "",
     "for (int i = 0; i < n; ++i) { switch (i & 3) { case 1: continue; case 2: t += 5.0; break; default: t "
     "+= 1.0; } t += 100.0; }",
     [](int n) {
         double t = 0;
         for (int i = 0; i < n; ++i) {
             if ((i & 3) == 1) continue;
             t += (i & 3) == 2 ? 5.0 : 1.0;
             t += 100.0;
         }
         return t;
     }},
    {"value_that_outlives_its_loop", "",
     "int last = -1; for (int i = 0; i < 9; ++i) { int square = i * i; last = square; if (square >= n) "
     "break; } t = float(last);",
     [](int n) {
         int last = -1;
         for (int i = 0; i < 9; ++i) {
             last = i * i;
             if (last >= n) break;
         }
         return static_cast<double>(last);
     }},
    {"phi_of_and_or", "",
     "bool both = n > 2 && 12 / n > 2; bool either = n < 2 || 12 / n == 2; t = (both ? 1.0 : 0.0) + (either "
     "? 2.0 : 0.0);",
     [](int n) { return (n > 2 && 12 / n > 2 ? 1.0 : 0.0) + (n < 2 || 12 / n == 2 ? 2.0 : 0.0); }},
    {"choice_operator", "", "t = n > 4 ? float(n) * 2.0 : n > 2 ? 7.0 : -1.0;",
     [](int n) { return n > 4   ? n * 2.0
                        : n > 2 ? 7.0
                                : -1.0; }},
    {"inout_parameters", "void swap(inout float x, inout float y) { float z = x; x = y; y = z; }",
     "float u = 3.0; t = float(n); if (n % 2 == 0) swap(t, u); t = t * 10.0 + u;",
     [](int n) { return n % 2 == 0 ? 30.0 + n : n * 10.0 + 3.0; }},
    {"calls_inside_calls",
     "float g(float x) { return x > 4.0 ? x : x * x; } float f(float x) { return g(x) + g(x + 1.0); }",
     "t = f(f(float(n)));",
     [](int n) {
         const auto g = [](double x) { return x > 4 ? x : x * x; };
         const auto f = [&](double x) { return g(x) + g(x + 1); };
         return f(f(n));
     }},
    {"loads_before_a_store_keep_their_value", "",
     "vec2 s = vec2(float(n), 1.0); s = s.yx; float x = s.x; s.x = 9.0; t = x * 100.0 + s.y;",
     [](int n) { return 100.0 + n; }},
};

class Flow : public ::testing::TestWithParam<Case> {};

TEST_P(Flow, EachLaneGoesItsOwnWay) {
    const std::string source =
        std::string(
            "#version 450\nlayout(location = 0) flat in int n;\nlayout(location = 0) out float r;\n") +
        GetParam().declarations + "\nvoid main() { float t = 0.0; " + GetParam().body + " r = t; }\n";
    const Program program = program_of(ShaderStage::fragment, source);
    Invocations invocations;
    invocations.count = 100;  // more than one batch, the second one not full
    for (int i = 0; i < 100; ++i) invocations.values["n"].push_back(i % 13);
    const Result<Outputs> outputs = run<float>(program, invocations);
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    // All numbers are small whole or half ones, which fp32 holds exactly.
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(outputs->values.at("r")[i], GetParam().expected(static_cast<int>(i) % 13))
            << "n = " << i % 13;
}

INSTANTIATE_TEST_SUITE_P(Ways, Flow, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Flow, DiscardEndsAnInvocation) {
    const Program program = fragment_of("r = vec4(1.0); if (a.x < 0.0) discard; r = vec4(2.0);");
    Invocations invocations;
    invocations.count = 3;
    invocations.values["a"] = {-1, 1, -2, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const Result<Outputs> outputs = run<double>(program, invocations);
    ASSERT_TRUE(outputs);
    EXPECT_THAT(outputs->discarded, ::testing::ElementsAre(true, false, true));
    EXPECT_THAT(std::vector<double>(outputs->values.at("r").begin(), outputs->values.at("r").begin() + 3),
                ::testing::ElementsAre(1, 2, 1));
}

TEST(Flow, NoInvocationsGiveNoValues) {
    Invocations invocations;
    invocations.count = 0;
    invocations.values["a"] = {};
    const Result<Outputs> outputs = run<double>(fragment_of("r = a;"), invocations);
    ASSERT_TRUE(outputs);
    EXPECT_TRUE(outputs->values.at("r").empty());
}

TEST(Flow, AnEndlessLoopIsAnErrorAtItsPlace) {
    const Program program = fragment_of("r = a;\nwhile (r.x < 2.0)\n  r.x *= 0.5;");
    Options options;
    options.iteration_limit = 1000;
    Invocations invocations;
    invocations.values["a"] = {1, 1, 1, 1};
    const Result<Outputs> outputs = run<float>(program, invocations, options);
    ASSERT_FALSE(outputs);
    EXPECT_EQ(to_text(outputs.error().front()),
              "test.glsl:9: error: a loop takes more than 1000 iterations\n");
}

}  // namespace
}  // namespace gobo::evaluate
