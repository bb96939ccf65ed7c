// What `gobo test --figures` writes is what was measured.
#include <limits>

#include <gtest/gtest.h>

#include "lab/verify/expectation.hpp"
#include "lab/verify/verify.hpp"
#include "lit_library.hpp"

namespace gobo {
namespace {

TEST(Figures, NameEachKeyWithItsPointsAndErrorsInTheirOrder) {
    const Family family = lit_family();
    const std::vector<Key> keys = keys_of(family, {"point=1", "fog=linear"});
    verify::VerifyReport report;
    report.permutations.resize(2);
    report.permutations[0].key = keys[0];
    report.permutations[0].figures = {512, 3, 0.25, 0.5, 0.75};
    report.permutations[1].key = keys[1];
    report.permutations[1].figures = {4, 0, 0, std::numeric_limits<double>::infinity(), 0};
    EXPECT_EQ(verify::figures_json(family, report), R"({
 "family": "lit",
 "permutations": [
  {
   "key": "point=1",
   "points": 512,
   "largest_fp32_error": 0.5,
   "largest_fp64_error": 0.25
  },
  {
   "key": "fog=linear",
   "points": 4,
   "largest_fp32_error": null,
   "largest_fp64_error": 0.0
  }
 ]
}
)");
}

TEST(Figures, MeasureBothPrecisionsAgainstTheLargestTerm) {
    const Family family = lit_family();
    const auto report = verify_lit(family, keys_of(family, {"point=1 specular=blinn", "default"}));
    ASSERT_TRUE(report) << to_text(report.error().front());
    const verify::Figures& figures = report->permutations[0].figures;
    EXPECT_GT(figures.largest_fp32_error, 0x1p-24) << "less than one rounding";
    EXPECT_LT(figures.largest_fp32_error, 1e-2);
    EXPECT_LT(figures.largest_fp64_error, verify::kDoubleTolerance);
    EXPECT_GT(figures.largest_fp32_error, 1e4 * figures.largest_fp64_error) << "29 binary digits lie between";
    EXPECT_GE(report->figures.largest_fp32_error, figures.largest_fp32_error);
}

}  // namespace
}  // namespace gobo
