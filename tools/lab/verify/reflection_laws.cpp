#include "lab/verify/reflection_laws.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lab/evaluate/evaluate.hpp"
#include "lab/oracle/oracle.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {
namespace {

using oracle::Model;

/// In doubles; a peak of alpha 0.002 multiplies a direction's rounding by 1 / alpha^2.
constexpr double kLawTolerance = 1e-6;

/// The radiances of the samples.
Result<std::vector<glm::dvec3>> radiances(const evaluate::Program& program,
                                          const std::vector<Sample>& samples) {
    GOBO_TRY(const auto inputs, bind_inputs(program, samples));
    GOBO_TRY(const auto outputs, evaluate::run<double>(program, inputs));
    const std::vector<double>& color = outputs.values.at("fragmentColor");
    std::vector<glm::dvec3> result;
    for (std::size_t i = 0; i < samples.size(); ++i)
        result.emplace_back(color[i], color[samples.size() + i], color[2 * samples.size() + i]);
    return result;
}

/// Nothing between surface and viewer, no picture that bends or hides, no light but what a law adds.
void make_plain(Sample& sample) {
    oracle::Scene& scene = sample.scene;
    scene.fog = {glm::dvec3(0), 0, 1e6, 2e6};
    scene.cutout_threshold = 0;
    scene.material.emission = glm::dvec3(0);
    scene.ambient = glm::dvec3(0);
    scene.hemisphere.sky = scene.hemisphere.ground = glm::dvec3(0);
    scene.harmonics.coefficients.fill(glm::dvec3(0));
    scene.image_light.color = scene.image_light.map.mean = glm::dvec3(0);
    scene.image_light.map.slope = scene.reflection.map.slope = glm::dmat3(0);
    scene.reflection.map.mean = glm::dvec3(0);
    scene.reflection.weight = 1;
    sample.surface.color = glm::dvec4(1);
    for (oracle::DirectionalLight& light : scene.directional) light.color = glm::dvec3(0);
    for (oracle::PointLight& light : scene.point) light.color = glm::dvec3(0);
    for (oracle::SpotLight& light : scene.spot) light.color = glm::dvec3(0);
    for (oracle::EvenPicture& picture : scene.pictures)
        picture = {glm::dvec4(1), glm::dvec4(0), glm::dvec4(0)};
    scene.pictures[static_cast<std::size_t>(oracle::MapKind::normal)].even = {0.5, 0.5, 1, 1};
}

/// The normal that the surface is shaded with, as the key has it.
glm::dvec3 shaded_normal(const Model& model, const Sample& sample) {
    const bool is_flipped = model.sides != oracle::Sides::one && sample.surface.is_back;
    return oracle::shading_direction(model, is_flipped ? -sample.surface.normal : sample.surface.normal);
}

void light_evenly(Sample& sample) {
    oracle::Scene& scene = sample.scene;
    scene.ambient = scene.hemisphere.sky = scene.hemisphere.ground = glm::dvec3(1);
    scene.harmonics.coefficients[0] = glm::dvec3(1 / 0.886227);
    scene.harmonics.scale = 1;
    scene.image_light.color = scene.image_light.map.mean = scene.reflection.map.mean = glm::dvec3(1);
}

/// A law of two sides that are alike: which keys it speaks of, and how both sides are made of a sample drawn
/// at random; false where it says nothing of that.
struct Law {
    const char* name;
    bool (*speaks_of)(const Model&);
    bool (*make)(const Model&, Sample& one, Sample& other);
};

bool has_one_sun(const Model& model) {
    return model.directional > 0 && model.directional_shadows == 0;
}

bool exchange(const Model& model, Sample& one, Sample& other) {
    make_plain(one);
    one.scene.material.clearcoat = 0;
    const glm::dvec3 n = shaded_normal(model, one);
    glm::dvec3 v = -glm::normalize(one.surface.position);
    glm::dvec3 l = glm::normalize(one.scene.directional[0].direction);
    if (glm::dot(n, v) < 0) v = v - 2 * glm::dot(n, v) / glm::dot(n, n) * n;
    if (glm::dot(n, l) < 0) l = l - 2 * glm::dot(n, l) / glm::dot(n, n) * n;
    const double nl = glm::dot(n, l);
    const double nv = glm::dot(n, v);
    if (std::min(nl, nv) < 0.02 * glm::length(n)) return false;
    const double distance = glm::length(one.surface.position);
    other = one;
    // Small enough for a display's range.
    one.surface.position = -distance * v;
    one.scene.directional[0] = {l, glm::dvec3(1e-7 / nl)};
    other.surface.position = -distance * l;
    other.scene.directional[0] = {v, glm::dvec3(1e-7 / nv)};
    return true;
}

bool mirror(const Model& /*model*/, Sample& one, Sample& other) {
    other = one;
    const auto turn = [](glm::dvec3& vector) { vector.x = -vector.x; };
    turn(other.surface.position);
    turn(other.surface.normal);
    glm::dvec3 tangent(other.surface.tangent);
    turn(tangent);
    other.surface.tangent = {tangent, -other.surface.tangent.w};
    for (oracle::DirectionalLight& light : other.scene.directional) turn(light.direction);
    for (oracle::PointLight& light : other.scene.point) turn(light.position);
    for (oracle::SpotLight& light : other.scene.spot) {
        turn(light.position);
        turn(light.axis);
    }
    return true;
}

bool hide_dielectric(const Model& /*model*/, Sample& one, Sample& other) {
    one.scene.material.metallic = 1;
    for (oracle::EvenPicture& picture : one.scene.pictures)
        picture.even.z = 1, picture.along_s.z = picture.along_t.z = 0;
    other = one;
    other.scene.material.dielectric = glm::dvec3(0.5) - 0.4 * one.scene.material.dielectric;
    other.scene.material.dielectric_edge = 1 - 0.7 * one.scene.material.dielectric_edge;
    return true;
}

const Law kLaws[] = {
    {"with light and viewer exchanged",
     [](const Model& m) {
         return has_one_sun(m) && m.viewer == oracle::Viewer::local &&
                m.multiple_scattering == oracle::MultipleScattering::none;
     },
     exchange},
    {"of the mirror image",
     [](const Model& m) {
         return m.shadows() == 0 && m.ambient == oracle::Ambient::global &&
                m.reflection == oracle::Reflection::none && m.normal_map != oracle::NormalMap::derivatives &&
                m.viewer == oracle::Viewer::local;
     },
     mirror},
    {"of metal over another dielectric", [](const Model&) { return true; }, hide_dielectric},
};

/// Counts a point, and keeps it where `actual` is outside [low, high].
void judge(const evaluate::Program& program, const evaluate::Invocations& inputs, std::size_t index,
           const std::string& output, const glm::dvec3& actual, const glm::dvec3& low, const glm::dvec3& high,
           double tolerance, StageReport& report) {
    bool has_failed = false;
    for (int c = 0; c < 3; ++c) {
        const double expected = std::clamp(actual[c], low[c], high[c]);
        const double ratio = ratio_of(std::abs(actual[c] - expected), tolerance);
        if (ratio <= 1) continue;
        has_failed = true;
        report.add({StageKind::fragment, Precision::fp64, output, static_cast<std::uint32_t>(c), expected,
                    actual[c], tolerance, ratio, evaluate::point_of(program, inputs, index)});
    }
    report.failed_points += has_failed ? 1 : 0;
}

/// In a world of radiance 1.
Result<void> check_furnace(const evaluate::Program& program, const Model& model, std::uint64_t seed,
                           bool is_white, StageReport& report) {
    std::vector<Sample> samples = make_samples(model, StageKind::fragment, kLawPoints, seed);
    bool is_metal = false;
    for (Sample& sample : samples) {
        make_plain(sample);
        light_evenly(sample);
        if (!is_white) continue;
        is_metal = !is_metal;
        sample.scene.material.metallic = is_metal ? 1 : 0;
        sample.scene.material.base_color = glm::dvec4(1);
        sample.scene.material.dielectric_edge = 1;
        sample.scene.material.clearcoat = 0;
        sample.scene.material.sheen_color = glm::dvec3(0);
    }
    GOBO_TRY(const auto found, radiances(program, samples));
    GOBO_TRY(const auto inputs, bind_inputs(program, samples));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool has_no_normal = samples[i].surface.normal == glm::dvec3(0);
        if (has_no_normal) continue;
        judge(program, inputs, i,
              is_white ? "fragmentColor of a white furnace" : "fragmentColor of a furnace", found[i],
              glm::dvec3(is_white ? 1 : 0), glm::dvec3(1), kLawTolerance, report);
    }
    report.figures.points += samples.size();
    return {};
}

Result<void> check(const evaluate::Program& program, const Model& model, const Law& law, std::uint64_t seed,
                   StageReport& report) {
    std::vector<Sample> one = make_samples(model, StageKind::fragment, kLawPoints, seed);
    std::vector<Sample> other = one;
    std::vector<bool> is_judged;
    for (std::size_t i = 0; i < one.size(); ++i) is_judged.push_back(law.make(model, one[i], other[i]));
    GOBO_TRY(const auto here, radiances(program, one));
    GOBO_TRY(const auto there, radiances(program, other));
    GOBO_TRY(const auto inputs, bind_inputs(program, one));
    for (std::size_t i = 0; i < one.size(); ++i) {
        if (!is_judged[i]) continue;
        const double size = std::max({here[i].x, here[i].y, here[i].z, there[i].x, there[i].y, there[i].z});
        judge(program, inputs, i, std::string("fragmentColor ") + law.name, here[i], there[i], there[i],
              kLawTolerance * size, report);
        ++report.figures.points;
    }
    return {};
}

}  // namespace

Result<StageReport> check_laws(const evaluate::Program& program, const Model& model, std::uint64_t seed) {
    StageReport report;
    if (model.lighting != oracle::Lighting::metallic_roughness) return report;
    GOBO_TRY_DO(check_furnace(program, model, seed, false, report));
    if (model.multiple_scattering == oracle::MultipleScattering::returned &&
        model.reflection == oracle::Reflection::image)
        GOBO_TRY_DO(check_furnace(program, model, seed, true, report));
    for (const Law& law : kLaws)
        if (law.speaks_of(model)) GOBO_TRY_DO(check(program, model, law, seed, report));
    return report;
}

}  // namespace gobo::verify
