// The search over the whole domain finds what no scene of the study shows, and every promise planted false.
#include "lab/study/worst_case.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "budget/budget.hpp"
#include "family/key.hpp"
#include "lab/study/qualities.hpp"
#include "study_support.hpp"

namespace gobo::study {
namespace {

std::vector<WorstCase> searched(const std::vector<std::string>& effects, std::vector<Domain> domains = {}) {
    std::vector<Key> keys;
    for (const std::string& text : effects)
        keys.push_back(effects_of(lit_under_study().family, lit_key(text)));
    return find_worst_cases(lit_subject(), keys, {}, {4096, 1, std::move(domains)}).value();
}

double worst_of(const std::vector<WorstCase>& cases, const std::string& quality) {
    double worst = -1;
    for (const WorstCase& one : cases)
        if (quality_text(lit_under_study().family, one.key) == quality) worst = std::max(worst, one.error);
    return worst;
}

const std::vector<WorstCase>& all_cases() {
    static const std::vector<WorstCase> cases =
        searched({"spot=1", "directional=1 specular=blinn", "directional=1 specular=phong",
                  "point=1 fog=linear", "point=1 fog=exponential"});
    return cases;
}

TEST(WorstCase, IsFoundWhereNoSceneIs) {
    EXPECT_GT(worst_of(all_cases(), "spot_edge=cosine"), 0.5);  // cones of less than a degree
    EXPECT_GT(worst_of(all_cases(), "power=squaring"), 0.2);    // shininess 0.5
    for (const WorstCase& one : all_cases())
        EXPECT_LE(one.accurate_error, one.error) << key_text(lit_under_study().family, one.key);
}

TEST(WorstCase, IsSmallerInANarrowerDomain) {
    Domain cone;
    cone.name = "SpotLights.lights[].outerOneMinusCosine";
    cone.low = 0.06;  // 20 degrees
    cone.high = 2;
    Domain inner = cone;
    inner.name = "SpotLights.lights[].innerOneMinusCosine";
    inner.low = 0;
    inner.high = 0.03;
    const auto narrow = searched({"spot=1"}, {cone, inner});
    EXPECT_LT(worst_of(narrow, "spot_edge=cosine"), worst_of(all_cases(), "spot_edge=cosine") / 100);
}

TEST(WorstCase, IsTheSameOnEveryRun) {
    const auto again = searched({"spot=1"});
    ASSERT_FALSE(again.empty());
    for (const WorstCase& one : again) {
        const auto same =
            std::ranges::find_if(all_cases(), [&](const WorstCase& other) { return other.key == one.key; });
        ASSERT_NE(same, all_cases().end());
        EXPECT_EQ(same->error, one.error);
    }
}

/// Each value's promise is planted at half of its worst error and less, and once above it.
TEST(WorstCase, BreaksEveryPromisePlantedFalse) {
    const Family& family = lit_under_study().family;
    std::vector<Promise> planted;
    std::vector<Promise> kept;
    for (const char* quality : {"spot_edge=cosine", "spot_edge=angle", "power=near_exact", "power=squaring",
                                "power=gaussian_fitted", "power=gaussian", "power=lyon", "power=schlick",
                                "viewer=infinite", "fog_distance=planar"}) {
        ASSERT_GT(worst_of(all_cases(), quality), 0.02) << quality;
        planted.push_back({quality, 0.01});
        planted.push_back({quality, worst_of(all_cases(), quality) / 2});
        kept.push_back({quality, 1.5 * worst_of(all_cases(), quality)});
    }
    EXPECT_EQ(broken_promises(family, planted, all_cases()).size(), 20U);
    EXPECT_TRUE(broken_promises(family, kept, all_cases()).empty());
}

}  // namespace
}  // namespace gobo::study
