// That verification passes what is right, finds what is wrong, and says so in a way one can work with.
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/raster/random.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/on_mesh.hpp"
#include "lab/verify/sample.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using verify::VerifyReport;

TEST(Verify, PassesTheLibraryAndKnowsAnOracleForIt) {
    const Family family = lit_family();
    const Result<VerifyReport> report = verify_lit(
        family,
        keys_of(family, {"default", "directional=2 specular=blinn spot=1", "point=1 shading=vertex"}));
    ASSERT_TRUE(report) << to_text(report.error().front());
    EXPECT_EQ(failed_points(*report), 0U);
    EXPECT_EQ(report->without_oracle, 0U);
    EXPECT_EQ(report->figures.points, 3U * (128 + 384));
    EXPECT_GT(report->figures.largest_fp32_ratio, 0.1) << "a bound ten times too wide proves little";
    EXPECT_LT(report->figures.largest_fp32_ratio, 1);
}

/// Replaces the only occurrence of `from`.
std::string changed(std::string text, const std::string& from, const std::string& to) {
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    EXPECT_EQ(text.find(from, place + 1), std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

struct Slip {
    std::string name;
    std::string piece;
    std::string from, to;
    std::string key;
};

TEST(Verify, FindsTheTextsSlips) {
    const std::vector<Slip> slips = {
        {"a highlight on the dark side", "lighting/response.glsl", "if (cosine > 0.0)", "if (cosine > -0.5)",
         "directional=1 specular=blinn"},
        {"an interpolated normal used as it is", "surface/normal.frag.glsl", "shadingDirection(eyeNormal)",
         "eyeNormal", "directional=1"},
        {"a band too few", "diffuse/toon.glsl", "float(toon.levels)", "float(toon.levels - 1)",
         "diffuse=toon directional=1"},
        {"the model-view matrix instead of its inverse transpose", "surface/normal.vert.glsl",
         "transform.normalMatrix * normal", "mat3(transform.modelView) * normal",
         "directional=1 shading=vertex"},
        {"a light's position not made relative to the surface", "shading/point_ray.glsl",
         ".position.xyz - surfacePosition()", ".position.xyz", "point=1"},
        {"the vector to the light where the cone wants the ray", "shading/spot_ray.glsl",
         "light.axis, -ray.xyz", "light.axis, ray.xyz", "spot=1"},
        {"attenuation without its square", "lighting/attenuation.glsl", "reach * coefficients.z",
         "coefficients.z", "point=1"},
        {"fog by the wrong distance", "fog_distance/planar.glsl", "surfacePosition().z",
         "surfacePosition().y", "fog=linear fog_distance=planar"},
        {"a power good to floats only at small exponents", "power/exact.glsl", "oneMinusCosine > 0.1875",
         "oneMinusCosine >= 0.0", "directional=1 specular=blinn"},
    };
    const Family family = lit_family();
    for (const Slip& slip : slips) {
        const Overlay overlay = {{slip.piece, changed(piece_text(slip.piece), slip.from, slip.to)}};
        const Result<VerifyReport> report = verify_lit(family, keys_of(family, {slip.key}), overlay);
        ASSERT_TRUE(report) << slip.name << ": " << to_text(report.error().front());
        EXPECT_GT(failed_points(*report), 0U) << slip.name;
    }
}

TEST(Verify, TellsWhatRoundingsOfTheInputsDoNotExplain) {
    const Family family = lit_family();
    const auto keys = keys_of(family, {"directional=1 specular=blinn", "shading=hybrid spot=2"});
    const VerifyReport sound = verify_lit(family, keys).value();
    EXPECT_EQ(sound.figures.unexplained, 0U);
    EXPECT_GT(sound.figures.vacuous, 0U) << "where components of rays cancel, the bound is above them";
    EXPECT_EQ(sound.figures.loose, 0U) << "but small beside the light";
    const std::string piece = "shading/point_ray.glsl";
    const Overlay overlay = {{piece, changed(piece_text(piece), ".position.xyz - surfacePosition()",
                                             ".position.xyz + 1e4 - (surfacePosition() + 1e4)")}};
    const VerifyReport report = verify_lit(family, keys_of(family, {"point=1"}), overlay).value();
    EXPECT_GT(report.figures.unexplained, 0U);
    const auto& worst = report.permutations.front().least_explained;
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->output, "fragmentColor");
    EXPECT_GT(worst->ratio, 1);
    EXPECT_FALSE(worst->point.inputs.empty());
}

struct Demanding {
    const char* name;
    const char* key;
};

/// Keys whose points once were out of tolerance, each with what was wrong.
constexpr Demanding demanding[] = {
    {"near_exact_of_small_exponents: 1.0 / 3.0 was rounded to a float, in fp64 too",
     "cutout=threshold depth=less directional=4 directional_or_point=5 fog=exponential guards=ordinary "
     "light_sum=pairwise material=array power=near_exact shading=vertex shadow_filter=sampler sides=two "
     "specular=blinn spot=5 spot_edge=angle spot_shadows=1 vertex_color=modulate viewer=infinite"},
    {"texels_asked_beside_their_centres: a light wholly in shadow shone by a rounding of the lookup's place",
     "ambient=spherical_harmonics cutout=threshold depth=unchanged directional=3 directional_shadows=3 "
     "harmonics=zeroth material=array normal=interpolated point=2 point_shadows=2 power=schlick "
     "shading=hybrid shadow_filter=nearest specular=blinn spot=1 spot_edge=angle vertex_color=modulate "
     "viewer=infinite"},
};

TEST(Verify, PassesWhatOnceWasOutOfTolerance) {
    const Family family = lit_family();
    for (const Demanding& row : demanding) {
        verify::VerifyOptions options;
        options.meshes = verify::test_meshes(
            read_obj(DiskFileSystem(), std::string(GOBO_SOURCE_DIR) + "/data/meshes/teapot.obj").value());
        const Result<VerifyReport> report = verify_lit(family, keys_of(family, {row.key}), {}, options);
        ASSERT_TRUE(report) << row.name << ": " << to_text(report.error().front());
        EXPECT_EQ(failed_points(*report), 0U) << row.name;
    }
}

TEST(Verify, GivesTheSameFiguresWithAnyNumberOfThreadsAndInAnySelection) {
    const Family family = lit_family();
    const auto keys = keys_of(family, {"diffuse=toon point=2", "fog=linear spot=3", "point=1", "spot=8"});
    verify::VerifyOptions four_threads;
    four_threads.jobs = 4;
    const VerifyReport one = verify_lit(family, keys).value();
    const VerifyReport four = verify_lit(family, keys, {}, four_threads).value();
    const VerifyReport alone = verify_lit(family, {keys[1]}).value();
    EXPECT_EQ(one.figures.largest_fp32_ratio, four.figures.largest_fp32_ratio);
    EXPECT_EQ(one.figures.largest_fp64_error, four.figures.largest_fp64_error);
    EXPECT_EQ(one.figures.edges, four.figures.edges);
    EXPECT_EQ(one.permutations[1].figures.largest_fp32_ratio, alone.figures.largest_fp32_ratio);
}

TEST(Verify, WritesAFailingPointAsAnInputOfEval) {
    verify::Failure failure{StageKind::fragment,
                            verify::Precision::fp32,
                            "fragmentColor",
                            1,
                            0.5,
                            0.25,
                            1e-6,
                            9,
                            {{{"eyeNormal", {0, 0, 0.1}}}, {{"Fog.start", {2}}}, {}, 0, ""}};
    EXPECT_EQ(verify::eval_input(failure, "fog=linear"),
              "# fog=linear: fp32 fragmentColor[1] is 0.25, should be 0.5 within 1e-06\n"
              "stage = \"fragment\"\n"
              "\n[inputs]\n\"eyeNormal\" = [0, 0, 0.1]\n"
              "\n[uniforms]\n\"Fog.start\" = 2\n");
}

/// The fragment stage of the first key.
evaluate::Program fragment_of(const Family& family, const std::vector<Key>& keys) {
    const Composition composition = compose_lit(family, keys, {}).value();
    const Validated validated = validate(family, composition, {.keep_spirv = true});
    return evaluate::decode(validated.stage(composition.permutations[0].stages[StageKind::fragment]).spirv)
        .value();
}

TEST(Verify, AsksTheOracleAboutAnyInvocation) {
    Family family = lit_family();
    const auto keys = keys_of(family, {"depth=any directional=2 fog=linear point=1 specular=phong spot=2"});
    const evaluate::Program program = fragment_of(family, keys);
    const oracle::Model model = oracle::model_of(family, keys[0]).value();
    const auto samples = verify::make_samples(model, StageKind::fragment, 1, 3);
    const auto invocation = verify::bind_inputs(program, samples).value();
    const auto outputs = evaluate::run<double>(program, invocation).value();
    const auto answers = verify::ask_oracle(family, keys[0], StageKind::fragment, program, invocation);
    ASSERT_TRUE(answers.has_value());
    ASSERT_EQ(answers->size(), 2U) << "fragmentColor and gl_FragDepth";
    for (const verify::Answer& answer : *answers)
        for (std::size_t c = 0; c < answer.value.size(); ++c)
            EXPECT_NEAR(outputs.values.at(answer.output)[c], answer.value[c], 1e-8)  // ten times 1e-9
                << answer.output;
    family.name = "mine";
    EXPECT_FALSE(verify::ask_oracle(family, keys[0], StageKind::fragment, program, invocation));
}

/// A lamp a thousandth away: what rounding the inputs does is far more than what the arithmetic does.
TEST(Verify, BoundsFloatsWhoseInputsNoFloatHolds) {
    const Family family = lit_family();
    const auto keys = keys_of(family, {"point=1"});
    const evaluate::Program program = fragment_of(family, keys);
    const oracle::Model model = oracle::model_of(family, keys[0]).value();
    auto invocation =
        verify::bind_inputs(program, verify::make_samples(model, StageKind::fragment, 1, 3)).value();
    invocation.values["eyePosition"] = {0.1, 0.2, -3.3};
    invocation.values["eyeNormal"] = {0, 0.6, 0.8};
    invocation.values["PointLights.lights[0].position"] = {0.1003, 0.2007, -3.2994, 1};
    invocation.values["PointLights.lights[0].attenuation"] = {1, 0, 1};
    const auto answers = verify::ask_oracle(family, keys[0], StageKind::fragment, program, invocation);
    ASSERT_TRUE(answers.has_value());
    const auto outputs = evaluate::run<float>(program, invocation).value();
    const verify::Answer& color = answers->front();
    for (std::size_t c = 0; c < color.value.size(); ++c)
        EXPECT_NEAR(outputs.values.at(color.output)[c], color.value[c], color.float_error[c]) << c;
}

TEST(Verify, KeepsTheWorstPoints) {
    verify::StageReport report;
    for (const double ratio : {2.0, 5.0, 3.0, 9.0, 4.0}) {
        verify::Failure failure;
        failure.ratio = ratio;
        report.add(failure);
    }
    std::vector<double> kept;
    for (const verify::Failure& failure : report.worst) kept.push_back(failure.ratio);
    EXPECT_EQ(kept, (std::vector<double>{9, 5, 4}));
}

TEST(Verify, DrawsTheSameNumbersOnEveryMachine) {
    Random random(1);
    EXPECT_EQ(random.bits(), 0x910A2DEC89025CC1U) << "the published sequence of SplitMix64 from seed 1";
    EXPECT_EQ(random.bits(), 0xBEEB8DA1658EEC67U);
}

TEST(Verify, DrawsNumbersWithinTheirRanges) {
    RandomNumbers<SplitMix64> random(5);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LT(random.index(3), 3u);
        const int whole = random.whole(-2, 2);
        EXPECT_TRUE(whole >= -2 && whole <= 2) << whole;
        const double across = random.across(1, 100);
        EXPECT_TRUE(across >= 1 && across < 100) << across;
    }
}

TEST(Verify, RoundsEveryNumberOfASampleToAFloat) {
    oracle::Model model;
    model.directional = model.point = model.spot = 2;
    for (const verify::Sample& sample : verify::make_samples(model, StageKind::fragment, 16, 7)) {
        const verify::Sample rounded = verify::rounded_to_float(sample);
        const oracle::SpotLight& light = rounded.scene.spot[1];
        for (const glm::dvec3& vector : {rounded.surface.position, rounded.surface.normal, light.position,
                                         light.color, rounded.scene.directional[0].color})
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(vector[i], static_cast<double>(static_cast<float>(vector[i])));
        EXPECT_NE(rounded.surface.position, sample.surface.position);
    }
}

}  // namespace
}  // namespace gobo
