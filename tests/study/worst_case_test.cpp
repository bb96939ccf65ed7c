// The search over the whole domain finds what no scene of the study shows, and every promise planted false.
#include "lab/study/worst_case.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "budget/budget.hpp"
#include "family/constraint.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/oracle/model.hpp"
#include "lab/study/qualities.hpp"
#include "lab/study/worst_inputs.hpp"
#include "lab/verify/expectation.hpp"
#include "study_support.hpp"

namespace gobo::study {
namespace {

/// The most accurate key and every single choice of some effects, over a domain.
std::vector<WorstCase> searched(const std::vector<std::string>& effects,
                                const std::vector<Domain>& narrower = {}, std::size_t points = 4096) {
    Family family = lit_under_study().family;
    EXPECT_TRUE(narrow_domains(family, narrower));
    std::vector<Key> keys;
    for (const std::string& text : effects) {
        const Key of = effects_of(family, lit_key(text));
        keys.push_back(most_accurate(family, of));
        for (const Choice& choice : single_choices(family, of)) keys.push_back(choice.key);
    }
    const Subject subject = lit_subject();
    return find_worst_cases({subject.shipped, family, subject.search, subject.jobs}, keys, {points}).value();
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
    EXPECT_GT(worst_of(all_cases(), "spot_edge=cosine"), 0.5);     // cones of less than a degree
    EXPECT_GT(worst_of(all_cases(), "power=squaring"), 0.2);       // shininess 0.5
    EXPECT_GT(worst_of(all_cases(), "normal=interpolated"), 0.5);  // normals much shorter than 1
    EXPECT_GT(worst_of(all_cases(), "guards=ordinary"), 0.5);      // lamps and viewers nearer than 1e-15
    EXPECT_EQ(worst_of(all_cases(), ""), 0) << "the most accurate quality errs by nothing but roundings";
}

/// Highlights look at the viewer: where the domain keeps the surface away from it, no vector is tiny.
TEST(WorstCase, OfOrdinaryGuardsIsNoneAwayFromTheViewer) {
    const std::string effects = "directional=1 specular=blinn";
    Domain depth;
    depth.name = "eyePosition.z";
    depth.low = -1e3;
    depth.high = -0.1;
    EXPECT_GT(worst_of(searched({effects}), "guards=ordinary"), 0.5);
    EXPECT_EQ(worst_of(searched({effects}, {depth}), "guards=ordinary"), 0);
}

Subject pbr_subject() {
    static const Family family = [] {
        const auto of_templates = [](const std::string& name) {
            const std::string path = "templates/" + name + ".toml";
            return Result<FamilyText>(FamilyText{source_files().read(path).value(), path});
        };
        const FamilyText pbr = of_templates("pbr").value();
        return read_family(pbr.text, pbr.path, of_templates).value();
    }();
    const Subject lit = lit_subject();
    return {lit.shipped, family, lit.search, lit.jobs};
}

/// Rough metals lose up to half of their light to a second reflection; what gives it back looks up a table,
/// which holds what an application's does.
TEST(WorstCase, FindsWhatATableOfTheEnvironmentBrdfGivesBack) {
    const Subject pbr = pbr_subject();
    const Key once = parse_key(pbr.family, "diffuse_lobe=oren_nayar directional=1 fresnel=exact").value();
    const auto found = find_worst_cases(pbr, {once}, {2048}).value();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_GT(found[0].error, 0.1);
}

/// However bright or sharp a highlight: what a formula makes of it is a part of what a mirror would show.
TEST(WorstCase, OfAPhysicalSurfaceIsAPartOfWhatAWhiteOneWouldSend) {
    const Subject pbr = pbr_subject();
    const Key accurate =
        parse_key(pbr.family,
                  "diffuse_lobe=oren_nayar directional=1 environment_brdf=table fog=exponential "
                  "fresnel=exact light_sum=compensated multiple_scattering=returned spot=1")
            .value();
    std::vector<Key> keys = {accurate};
    for (const Choice& choice : single_choices(pbr.family, effects_of(pbr.family, accurate)))
        keys.push_back(choice.key);
    const auto found = find_worst_cases(pbr, keys, {4096}).value();
    for (const WorstCase& one : found) {
        const std::string quality = quality_text(pbr.family, one.key);
        if (quality.empty()) {
            EXPECT_LT(one.error, 1e-9);
        }
        // None of these moves a highlight.
        for (const char* const bounded : {"diffuse_lobe", "environment_brdf", "fresnel", "spot_edge"})
            if (quality.starts_with(bounded)) {
                EXPECT_LT(one.error, 1.2) << quality;
            }
    }
}

/// A metal that mirrors all but 4e-4 of a bright light: the part that enters is known to a rounding of 1.
TEST(WorstCase, OfTheMostAccurateSurfaceIsExplainedByRoundings) {
    const Subject pbr = pbr_subject();
    const Key key = parse_key(pbr.family,
                              "diffuse_lobe=oren_nayar directional=1 environment_brdf=table fresnel=exact "
                              "multiple_scattering=returned")
                        .value();
    const Variants variants = load_variants(pbr, {key}).value();
    const evaluate::Program& program = variants.at(key).program.fragment;
    const auto inputs = evaluate::read_eval_inputs(R"([inputs]
eyeNormal = [1.3650545e-06, -1.1453416e-06, 4.3881283e-07]
eyePosition = [-29.340603, -18.572136, -62.32789]
[uniforms]
"DirectionalLights.lights[0].color" = [90067.14, 100000, 1.5607331]
"DirectionalLights.lights[0].direction" = [-0.24118619, -0.8966887, 0.37118542]
"Material.baseColor" = [1, 0.9999857, 0.24180223, 0.2955364]
"Material.dielectric" = [0.029608965, 1, 0.1824261]
"Material.dielectricEdge" = 0.99998593
"Material.metallic" = 0.79284656
"Material.roughness" = 9.427668e-05
[samplers]
environmentBrdfTable = [0.89206636, 0.10789559, 0, 1]
)",
                                                   "mirror.toml");
    const auto invocation = evaluate::invocations_of(inputs.value(), program).value();
    const auto answers =
        verify::ask_oracle(pbr.family, key, StageKind::fragment, program, invocation).value();
    const auto outputs = evaluate::run<float>(program, invocation).value();
    const verify::Answer& color = answers.front();
    for (std::size_t c = 0; c < color.value.size(); ++c)
        EXPECT_NEAR(outputs.values.at(color.output)[c], color.value[c], color.float_error[c]) << c;
}

struct Lights {
    const char* name;
    const char* effects;
};

class WorstCaseOfLights : public testing::TestWithParam<Lights> {};

/// A light's error shows whole where the others are dark, however many there are.
TEST_P(WorstCaseOfLights, IsNoLessAmongMoreLights) {
    const auto many = searched({GetParam().effects}, {}, 16384);
    for (const char* quality : {"power=near_exact", "power=gaussian_fitted", "power=gaussian", "power=lyon",
                                "power=schlick", "normal=interpolated", "viewer=infinite"})
        EXPECT_GT(worst_of(many, quality), 0.6 * worst_of(all_cases(), quality)) << quality;
}

INSTANTIATE_TEST_SUITE_P(
    Rows, WorstCaseOfLights,
    testing::Values(Lights{"of_each_kind", "directional=1 fog=exponential point=1 specular=blinn spot=1"},
                    Lights{"eight_directional", "directional=8 specular=blinn"},
                    Lights{"eight_point", "point=8 specular=blinn"},
                    Lights{"eight_spot", "specular=blinn spot=8"},
                    Lights{"eight_of_either_kind", "directional_or_point=8 specular=blinn"}),
    [](const auto& row) { return row.param.name; });

/// How far points stand from the middle of the view, in degrees.
struct ViewAngle {
    const char* name;
    double from;
    double to;
};

class WorstInputsInView : public testing::TestWithParam<ViewAngle> {};

TEST_P(WorstInputsInView, AreAtEveryAngle) {
    const auto model = oracle::model_of(lit_under_study().family, lit_key("directional=1 spot=1")).value();
    SearchRandom random(1);
    int count = 0;
    for (verify::Sample& sample : verify::make_samples(model, StageKind::fragment, 4000, 1)) {
        const double before = glm::distance(sample.surface.position, sample.scene.spot[0].position);
        bring_to_edges(sample, random);
        EXPECT_NEAR(glm::distance(sample.surface.position, sample.scene.spot[0].position), before,
                    1e-9 * (1 + before + glm::length(sample.surface.position)));
        const glm::dvec3 to = glm::normalize(sample.surface.position);
        const double angle = std::atan2(glm::length(glm::dvec2(to)), -to.z) * 180 / std::numbers::pi;
        if (angle >= GetParam().from && angle < GetParam().to) ++count;
    }
    EXPECT_GE(count, 40);
}

INSTANTIATE_TEST_SUITE_P(Rows, WorstInputsInView,
                         testing::Values(ViewAngle{"a_tenth", 0.05, 0.2}, ViewAngle{"one", 0.5, 2},
                                         ViewAngle{"ten", 5, 20}, ViewAngle{"thirty", 25, 35},
                                         ViewAngle{"sixty", 50, 70}, ViewAngle{"beside", 85, 95}),
                         [](const auto& row) { return row.param.name; });

TEST(WorstCase, IsNoneWhereVerticesComputeTheLight) {
    for (const WorstCase& one : searched({"point=1 diffuse=toon"})) {
        const std::string quality = quality_text(lit_under_study().family, one.key);
        EXPECT_EQ(quality.find("shading"), std::string::npos) << quality;
        EXPECT_EQ(quality.find("n_dot_l"), std::string::npos) << quality;
    }
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
    Domain exponent = cone;
    exponent.name = "SpotLights.lights[].exponent";
    exponent.low = 0;
    exponent.high = 64;
    const auto narrow = searched({"spot=1"}, {cone, inner, exponent});
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
    for (const char* quality : {"spot_edge=cosine", "normal=interpolated", "power=near_exact",
                                "power=squaring", "power=gaussian_fitted", "power=gaussian", "power=lyon",
                                "power=schlick", "viewer=infinite", "fog_distance=planar"}) {
        ASSERT_GT(worst_of(all_cases(), quality), 0.02) << quality;
        planted.push_back({quality, 0.01});
        planted.push_back({quality, worst_of(all_cases(), quality) / 2});
        kept.push_back({quality, 1.5 * worst_of(all_cases(), quality)});
    }
    EXPECT_EQ(broken_promises(family, planted, all_cases()).size(), 20U);
    EXPECT_TRUE(broken_promises(family, kept, all_cases()).empty());
}

/// One key with one name declared mediump.
Result<std::vector<WorstCase>> with_mediump(const std::string& key, const std::string& name,
                                            const std::vector<Domain>& narrower = {}) {
    Family family = lit_under_study().family;
    EXPECT_TRUE(narrow_domains(family, narrower));
    const Subject subject = lit_subject();
    return find_worst_cases({subject.shipped, family, subject.search, subject.jobs}, {lit_key(key)},
                            {.points = 4096, .mediump = name});
}

/// Each component is rounded by 2^-11 of itself at most, so that the vector turns by no more, and the light
/// of its cosine changes by no more.
TEST(WorstCase, OfANormalInMediumpIsItsRounding) {
    Domain normal;
    normal.name = "eyeNormal";
    normal.of_length = true;
    normal.low = 0.5;
    normal.high = 1;
    const auto found = with_mediump("directional=1", "eyeNormal", {normal}).value();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_GT(found[0].error, 1e-4);
    EXPECT_LT(found[0].error, 0x1p-11);
}

TEST(WorstCase, KeepsWhatIsStatedOfAComponent) {
    Domain depth;
    depth.name = "eyePosition.z";
    depth.low = -20;
    depth.high = -10;
    for (const WorstCase& one : searched({"point=1 fog=linear"}, {depth}, 512)) {
        const auto position = one.input.inputs.find("eyePosition");
        if (position == one.input.inputs.end()) continue;
        EXPECT_GE(position->second.at(2), -20) << quality_text(lit_under_study().family, one.key);
        EXPECT_LE(position->second.at(2), -10) << quality_text(lit_under_study().family, one.key);
    }
}

/// The order that samples do not have by themselves.
TEST(WorstCase, KeepsAnOrderOfTwoMembers) {
    Domain order;
    order.name = "Fog.end < Fog.start";
    for (const WorstCase& one : searched({"point=1 fog=linear"}, {order}, 2048)) {
        const auto start = one.input.uniforms.find("Fog.start");
        if (start == one.input.uniforms.end()) continue;
        EXPECT_GT(start->second.at(0), one.input.uniforms.at("Fog.end").at(0))
            << quality_text(lit_under_study().family, one.key);
    }
}

TEST(WorstCase, OfAVariableInMediumpIsFoundWhereItOverflows) {
    EXPECT_TRUE(
        std::isinf(with_mediump("directional=1", "total").value().at(0).error));  // light above 65,504
    EXPECT_LT(with_mediump("spot=1", "fade").value().at(0).error,
              0x1p-10);  // within [0, 1], and then squared
}

struct PrecisionCase {
    const char* name;
    const char* effects;
    std::vector<Domain> narrower;
    double least;
    double most;
};

class WorstCaseOfPrecision : public testing::TestWithParam<PrecisionCase> {};

/// A sum of lights rounded to 11 bits, or infinite above 65,504; and no budget has it to choose.
TEST_P(WorstCaseOfPrecision, IsWhatHalfFloatsMakeOfLight) {
    Family family = lit_under_study().family;
    ASSERT_TRUE(narrow_domains(family, GetParam().narrower));
    const Key effects = lit_key(GetParam().effects);
    const std::vector<Key> keys = choices_of_es300(family, effects);
    ASSERT_EQ(keys.size(), 1U);
    const Subject subject = lit_subject();
    const auto found =
        find_worst_cases({subject.shipped, family, subject.search, subject.jobs}, keys, {8192}).value();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_GE(found[0].error, GetParam().least);
    EXPECT_LE(found[0].error, GetParam().most);
    const int precision = family.index_of("precision").value();
    for (const Key& key : all_qualities(family, effects, 100000)) EXPECT_EQ(key[precision], 0);
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Rows, WorstCaseOfPrecision,
    testing::Values(PrecisionCase{"whole_domain", "directional=1", {}, kInfinite, kInfinite},
                    PrecisionCase{"light_of_a_game",
                                  "directional=1",
                                  {plain_domain("DirectionalLights.lights[].color", 0, 10)},
                                  0x1p-13,
                                  0x1p-10},
                    PrecisionCase{"lights_of_a_game",
                                  "directional=1 spot=1",
                                  {plain_domain("DirectionalLights.lights[].color", 0, 10),
                                   plain_domain("SpotLights.lights[].color", 0, 10),
                                   plain_domain("SpotLights.lights[].attenuation", 0.1, 1)},
                                  0x1p-12,
                                  0x1p-9}),
    [](const auto& row) { return row.param.name; });

TEST(WorstCase, OfMediumpNeedsSuchAName) {
    const auto found = with_mediump("directional=1", "fade");
    ASSERT_FALSE(found);
    EXPECT_EQ(to_text(found.error().front()),
              "gobo: error: no fragment stage has a float 'fade'\n"
              "  help: name a varying, or a variable as its piece declares it: vec3 litNormal\n");
}

}  // namespace
}  // namespace gobo::study
