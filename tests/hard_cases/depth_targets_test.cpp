// Hard cases (depth out of range, broken depth promise) in real depth targets: what a permutation writes, as
// 24-bit and 32-bit float targets hold it, against gl_FragCoord.z in the same target and against the
// evaluator.

#include <gtest/gtest.h>

#include "lit_cases.hpp"
#include "lit_drawing.hpp"
#include "lit_guards.hpp"

namespace gobo {
namespace {

struct Target {
    const char* name;
    Backend backend;
    DepthFormat format;
};

void PrintTo(const Target& target, std::ostream* out) {
    *out << target.name;
}

const Target kTargets[] = {{"osmesa_24_bits", Backend::osmesa, DepthFormat::bits24},
                           {"osmesa_float", Backend::osmesa, DepthFormat::float32},
                           {"egl_24_bits", Backend::egl, DepthFormat::bits24},
                           {"egl_float", Backend::egl, DepthFormat::float32}};

/// Whether the written depth stands to the surface's own as the qualifier promises. A target's rounding keeps
/// the order of any two depths, so the promise holds there exactly too.
bool is_kept(const std::string& key, double written, double own) {
    if (!(written >= 0 && written <= 1)) return false;
    if (key == "depth=greater") return written >= own;
    if (key == "depth=less") return written <= own;
    if (key == "depth=unchanged") return written == own;
    return key == "depth=any";
}

class DepthTarget : public testing::TestWithParam<Target> {};

TEST_P(DepthTarget, HoldsWhatWasPromised) {
    const Result<Context> context = open_context(GetParam().backend);
    // EGL is optional: OSMesa alone must draw, so only its absence is a failure.
    if (!context && GetParam().backend == Backend::egl) GTEST_SKIP() << to_text(context.error().front());
    ASSERT_TRUE(context);
    const Case* tested = case_named("depth_offsets");
    ASSERT_NE(tested, nullptr);
    const LitUnderTest lit(tested->where, tested->features, {});
    const LitUnderTest plain("depth == default", {"depth"}, {});  // leaves the depth to the driver
    LitDrawing untouched(*context, plain, 0);
    ASSERT_EQ(lit.size(), 4U);
    for (std::size_t permutation = 0; permutation < lit.size(); ++permutation) {
        LitDrawing drawing(*context, lit, permutation);
        for (const Inputs& point : tested->points) {
            const double own = *untouched.draw(point, GetParam().format).depth;
            const double written = *drawing.draw(point, GetParam().format).depth;
            EXPECT_TRUE(is_kept(lit.key(permutation), written, own))
                << lit.key(permutation) << " wrote " << written << " over " << own;
            Inputs same = point;
            same["gl_FragCoord"] = {0.5, 0.5, own, 1};
            // The steps of 24 bits are 6e-8, and a float's just below 1 are too; twice, since `own` was
            // rounded.
            const double evaluated = *lit.shade(permutation, same, sanitize::Machine::ieee).depth;
            EXPECT_NEAR(written, evaluated, 1.3e-7) << lit.key(permutation) << " over " << own;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, DepthTarget, testing::ValuesIn(kTargets),
                         [](const auto& tested) { return tested.param.name; });

/// A piece that breaks its promise is seen in the target: the test is able to fail.
TEST(DepthTargets, ShowABrokenPromise) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context);
    for (const Guard& guard : lit_guards()) {
        if (guard.name != "depth_greater_side") continue;
        const LitUnderTest broken("depth == greater", {"depth"}, {{guard.piece, without_guard(guard)}});
        LitDrawing drawing(*context, broken, 0);
        const Inputs point = {{"DepthOffset.offset", {-0.25}}, {"gl_FragCoord", {0.5, 0.5, 0.5, 1}}};
        EXPECT_FALSE(is_kept("depth=greater", *drawing.draw(point).depth, 0.5));
    }
}

}  // namespace
}  // namespace gobo
