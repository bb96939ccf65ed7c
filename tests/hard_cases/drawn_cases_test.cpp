// The hard cases as OpenGL draws them. Mesa's renderer hides most failures, which is why the evaluator has
// the first word; here it is the cross-check: finite, in bounds, and near what the evaluator gives.
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lit_cases.hpp"
#include "lit_drawing.hpp"

namespace gobo {
namespace {

using sanitize::Machine;

/// llvmpipe's powers, exponentials and logarithms are off by up to 8e-5 relative, its roots by 1.5 ulp, and
/// it adds up in another order.
bool is_near(const Shaded& drawn, const Shaded& evaluated) {
    for (std::size_t i = 0; i < 4; ++i)
        if (!(std::abs(drawn.color[i] - evaluated.color[i]) <= 2e-5 + 1e-4 * std::abs(evaluated.color[i])))
            return false;
    return true;
}

bool is_in_bounds(const Shaded& drawn) {
    for (const double channel : drawn.color)
        if (!(channel >= 0 && channel <= std::numeric_limits<float>::max())) return false;
    return true;
}

std::string color_text(const Shaded& shaded) {
    return fmt::format("({}, {}, {}, {})", shaded.color[0], shaded.color[1], shaded.color[2],
                       shaded.color[3]);
}

/// What is wrong with a point as drawn; empty where nothing is. The renderer may flush denormal numbers or
/// not, and at an edge decide otherwise than the evaluator, where the case allows both.
std::string fault_of(const Case& tested, const LitUnderTest& lit, std::size_t permutation,
                     const Inputs& point, const Shaded& drawn) {
    const Shaded evaluated = lit.shade(permutation, point, Machine::ieee);
    if (drawn.is_discarded != evaluated.is_discarded)
        return drawn.is_discarded ? "not drawn at all" : "drawn, though it is to be discarded";
    if (drawn.is_discarded) return {};
    if (!is_in_bounds(drawn)) return fmt::format("drawn as {}", color_text(drawn));
    if (is_near(drawn, evaluated) || is_near(drawn, lit.shade(permutation, point, Machine::flushed)))
        return {};
    if (tested.check({lit, permutation, point, Machine::ieee, drawn}).empty()) return {};
    return fmt::format("drawn as {}, evaluated as {}", color_text(drawn), color_text(evaluated));
}

class DrawnCase : public testing::TestWithParam<Case> {};

/// Each permutation that differs from others in two features takes part; all of them are evaluated.
TEST_P(DrawnCase, IsNearWhatIsEvaluated) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const Case& tested = GetParam();
    const LitUnderTest lit(tested.where, tested.features, {}, 2);
    ASSERT_GT(lit.size(), 0U);
    for (std::size_t permutation = 0; permutation < lit.size(); ++permutation) {
        LitDrawing drawing(*context, lit, permutation);
        for (const Inputs& point : tested.points)
            EXPECT_EQ(fault_of(tested, lit, permutation, point, drawing.draw(point)), "")
                << lit.key(permutation) << ", drawn by " << context->renderer();
    }
}

INSTANTIATE_TEST_SUITE_P(HardCases, DrawnCase, testing::ValuesIn(lit_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gobo
