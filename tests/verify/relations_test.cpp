// What must hold of the shaders whatever the models say: no oracle is asked.
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "lab/evaluate/evaluate.hpp"
#include "lab/oracle/model.hpp"
#include "lab/render/mesh.hpp"
#include "lab/verify/inputs.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using verify::Sample;
using Samples = std::vector<Sample>;
using Colors = std::vector<glm::dvec3>;

/// One output of a stage of a key, as fp64, at each sample.
Colors evaluate_at(const std::string& key, StageKind stage, const std::string& output,
                   const Samples& samples) {
    const Family family = lit_family();
    const Composition composition = compose_lit(family, keys_of(family, {key}), {}).value();
    ValidateOptions options;
    options.keep_spirv = true;
    const Validated validated = validate(family, composition, options);
    const Permutation& permutation = composition.permutations.front();
    const int index = permutation.stages[stage];
    const auto program = evaluate::decode(validated.stages[static_cast<std::size_t>(index)].spirv).value();
    const auto outputs =
        evaluate::run<double>(program, verify::bind_inputs(program, samples).value()).value();
    const std::vector<double>& values = outputs.values.at(output);
    Colors colors;
    for (std::size_t i = 0; i < samples.size(); ++i)
        colors.emplace_back(values[i], values[samples.size() + i], values[2 * samples.size() + i]);
    return colors;
}

Colors fragment_colors(const std::string& key, const Samples& samples) {
    return evaluate_at(key, StageKind::fragment, "fragmentColor", samples);
}

/// Samples with so many lights of each kind.
Samples samples_with(int directional, int point, int spot, StageKind stage = StageKind::fragment) {
    oracle::Model model;
    model.directional = directional;
    model.point = point;
    model.spot = spot;
    return verify::make_samples(model, stage, 256, 11);
}

Samples changed(Samples samples, const std::function<void(Sample&)>& change) {
    for (Sample& sample : samples) change(sample);
    return samples;
}

/// Colours are a few units large and the same but for some hundred roundings of doubles, which ordinary
/// inputs amplify by up to 1e5 (a shininess of 1e3 times a light at a hundredth of the coordinates).
void expect_equal(const Colors& actual, const Colors& expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i)
        EXPECT_LE(glm::length(actual[i] - expected[i]), 1e-9 * (1 + glm::length(expected[i])))
            << "sample " << i;
}

TEST(Relations, TheOrderOfLightsDoesNotMatter) {
    const std::string key = "directional=3 point=3 specular=blinn spot=3";
    const Samples samples = samples_with(3, 3, 3);
    const Samples reversed = changed(samples, [](Sample& sample) {
        oracle::Scene& scene = sample.scene;
        std::reverse(scene.directional.begin(), scene.directional.end());
        std::reverse(scene.point.begin(), scene.point.end());
        std::reverse(scene.spot.begin(), scene.spot.end());
    });
    expect_equal(fragment_colors(key, reversed), fragment_colors(key, samples));
}

TEST(Relations, ALightOfNoIntensityIsNoLight) {
    const Samples fewer = samples_with(1, 1, 1);
    const Samples more = changed(fewer, [](Sample& sample) {
        oracle::Scene& scene = sample.scene;
        scene.directional.push_back({{0, 0, 1}, glm::dvec3(0)});
        scene.point.push_back(scene.point.front());
        scene.point.back().color = glm::dvec3(0);
        scene.spot.push_back(scene.spot.front());
        scene.spot.back().color = glm::dvec3(0);
    });
    expect_equal(fragment_colors("directional=2 point=2 specular=phong spot=2", more),
                 fragment_colors("directional=1 point=1 specular=phong spot=1", fewer));
}

TEST(Relations, OneLightOfTwiceTheIntensityIsTwoLights) {
    const Samples one = changed(samples_with(1, 1, 1), [](Sample& sample) {
        sample.scene.directional[0].color *= 2.0;
        sample.scene.point[0].color *= 2.0;
        sample.scene.spot[0].color *= 2.0;
    });
    const Samples two = changed(samples_with(1, 1, 1), [](Sample& sample) {
        sample.scene.directional.push_back(sample.scene.directional[0]);
        sample.scene.point.push_back(sample.scene.point[0]);
        sample.scene.spot.push_back(sample.scene.spot[0]);
    });
    expect_equal(fragment_colors("directional=2 diffuse=toon point=2 spot=2", two),
                 fragment_colors("directional=1 diffuse=toon point=1 spot=1", one));
}

struct Off {
    std::string name;
    std::string with, without;
    std::function<void(Sample&)> turn_off;
};

TEST(Relations, AnEffectTurnedOffIsAbsent) {
    const std::vector<Off> effects = {
        {"exponential fog of density 0", "fog=exponential point=1", "point=1",
         [](Sample& sample) { sample.scene.fog.density = 0; }},
        {"exponential squared fog of density 0", "fog=exponential_squared point=1", "point=1",
         [](Sample& sample) { sample.scene.fog.density = 0; }},
        {"linear fog that begins behind everything", "fog=linear point=1", "point=1",
         [](Sample& sample) { sample.scene.fog.start = 1e5, sample.scene.fog.end = 2e5; }},
        {"highlights of strength 0", "point=1 specular=blinn", "point=1",
         [](Sample& sample) { sample.scene.material.strength = 0; }},
        {"highlights of a surface that reflects nothing", "point=1 specular=phong", "point=1",
         [](Sample& sample) { sample.scene.material.specular = glm::dvec3(0); }},
    };
    for (const Off& effect : effects) {
        SCOPED_TRACE(effect.name);
        const Samples samples = changed(samples_with(0, 1, 0), effect.turn_off);
        expect_equal(fragment_colors(effect.with, samples), fragment_colors(effect.without, samples));
    }
}

TEST(Relations, ASpotLightOfAllDirectionsIsAPointLight) {
    const Samples spots = changed(samples_with(0, 0, 2), [](Sample& sample) {
        for (oracle::SpotLight& light : sample.scene.spot) {
            light.inner_one_minus_cosine = light.outer_one_minus_cosine = 2;
            light.exponent = 0;
            sample.scene.point.push_back(light);
        }
    });
    expect_equal(fragment_colors("specular=blinn spot=2", spots),
                 fragment_colors("point=2 specular=blinn", spots));
}

/// Everything in eye space turned about the viewer.
void turn(Sample& sample) {
    const glm::dmat4 matrix = glm::rotate(glm::dmat4(1), 0.8, glm::dvec3(2, -1, 3));
    const glm::dmat3 rotation(matrix);
    sample.surface.position = rotation * sample.surface.position;
    sample.surface.normal = rotation * sample.surface.normal;
    sample.model_view = matrix * sample.model_view;
    sample.normal_matrix = rotation * sample.normal_matrix;
    for (oracle::DirectionalLight& light : sample.scene.directional)
        light.direction = rotation * light.direction;
    for (oracle::PointLight& light : sample.scene.point) light.position = rotation * light.position;
    for (oracle::SpotLight& light : sample.scene.spot) {
        light.position = rotation * light.position;
        light.axis = rotation * light.axis;
    }
}

TEST(Relations, TurningEverythingTogetherChangesNothing) {
    for (const std::string specular : {"none", "phong", "blinn"}) {
        SCOPED_TRACE(specular);
        const std::string lights = "directional=2 point=2 spot=2 specular=" + specular;
        const Samples fragments = samples_with(2, 2, 2);
        expect_equal(fragment_colors(lights + " fog=exponential", changed(fragments, turn)),
                     fragment_colors(lights + " fog=exponential", fragments));
        const Samples vertices = samples_with(2, 2, 2, StageKind::vertex);
        const auto lit = [&](const Samples& samples) {
            return evaluate_at(lights + " shading=vertex", StageKind::vertex, "litRadiance", samples);
        };
        expect_equal(lit(changed(vertices, turn)), lit(vertices));
    }
}

/// A sphere of radius 1 four units ahead, lit from the front right, as a sample at one of its points.
Sample on_sphere(const glm::dvec3& position, const glm::dvec3& normal) {
    Sample sample;
    sample.model_view = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4));
    sample.object_position = position;
    sample.object_normal = normal;
    sample.surface = {position + glm::dvec3(0, 0, -4), normal};
    sample.scene.material.diffuse = glm::dvec3(0.6);
    sample.scene.material.specular = glm::dvec3(0.5);
    sample.scene.material.shininess = 20;
    sample.scene.point = {{{2, 1, 0}, glm::dvec3(4), {1, 0.1, 0.05}}};
    return sample;
}

/// Root mean square over the triangles' centres: shading at the corners, interpolated, against shading there.
double vertex_shading_error(int stacks) {
    const Mesh sphere = make_sphere(2 * stacks, stacks);
    Samples corners;
    for (std::size_t i = 0; i < sphere.positions.size(); ++i)
        corners.push_back(on_sphere(glm::dvec3(sphere.positions[i]), glm::dvec3(sphere.normals[i])));
    const Colors lit =
        evaluate_at("point=1 shading=vertex specular=blinn", StageKind::vertex, "litRadiance", corners);
    Samples centres;
    Colors interpolated;
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
        glm::dvec3 position(0), normal(0), color(0);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::size_t index = sphere.indices[i + corner];
            position += glm::dvec3(sphere.positions[index]) / 3.0;
            normal += glm::dvec3(sphere.normals[index]) / 3.0;
            color += lit[index] / 3.0;
        }
        centres.push_back(on_sphere(position, normal));
        interpolated.push_back(color);
    }
    const Colors exact = fragment_colors("point=1 specular=blinn", centres);
    double sum = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(exact[i].r - interpolated[i].r, 2);
    return std::sqrt(sum / static_cast<double>(exact.size()));
}

TEST(Relations, FinerTessellationBringsVertexShadingTowardsFragmentShading) {
    // Linear interpolation is off by the square of the edge's length: a quarter with every halving. The
    // light's horizon, where the radiance has a kink, spoils a little of it.
    double coarser = vertex_shading_error(8);
    EXPECT_GT(coarser, 1e-3) << "a coarse sphere must show the difference";
    for (const int stacks : {16, 32, 64}) {
        const double error = vertex_shading_error(stacks);
        EXPECT_LT(error, 0.4 * coarser) << stacks << " stacks";
        coarser = error;
    }
}

}  // namespace
}  // namespace gobo
