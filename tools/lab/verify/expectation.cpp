#include "lab/verify/expectation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lab/oracle/oracle.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/rounding.hpp"
#include "lab/verify/sample_effects.hpp"

namespace gobo::verify {
namespace {

template <glm::length_t size>
using Vector = glm::vec<size, double>;

template <glm::length_t size>
Expected expected(std::string output, const Vector<size>& value,
                  const Vector<size>& largest = Vector<size>(0),
                  const Vector<size>& float_error = Vector<size>(0)) {
    Expected result{std::move(output), size, {}, {}, {}};
    for (int i = 0; i < size; ++i) {
        const auto index = static_cast<std::size_t>(i);
        result.value[index] = value[i];
        result.largest[index] = largest[i];
        result.float_error[index] = float_error[i];
    }
    return result;
}

glm::dmat3 absolute(const glm::dmat3& matrix) {
    return {glm::abs(matrix[0]), glm::abs(matrix[1]), glm::abs(matrix[2])};
}

/// A point transformed: products and sums of four terms, so at most four roundings of the terms' sum.
struct Placed {
    glm::dvec3 value{0};
    glm::dvec3 largest{0};
};

Placed place(const Sample& sample) {
    const glm::dmat3 turn(sample.model_view);
    const glm::dvec3 move(sample.model_view[3]);
    return {turn * sample.object_position + move,
            absolute(turn) * glm::abs(sample.object_position) + glm::abs(move)};
}

Expected expect_clip_position(const Sample& sample, const Placed& placed) {
    glm::dvec4 value = sample.projection[3];
    glm::dvec4 largest = glm::abs(value);
    for (int column = 0; column < 3; ++column) {
        value += sample.projection[column] * placed.value[column];
        largest += glm::abs(sample.projection[column]) * placed.largest[column];
    }
    return expected("gl_Position", value, largest, 8 * kUnitRoundoff * largest);  // two transformations
}

/// The unit normal in eye space, and its relative error: three roundings of the terms' sum before it is made
/// unit. A sum of three components' errors is at most sqrt(3) times the largest.
struct EyeNormal {
    glm::dvec3 value{0};
    double error = 0;
};

/// The unit tangent in eye space and the bitangent's sign, which a mirrored model turns round.
Expected expect_tangent(const Sample& sample) {
    const glm::dmat3 matrix(sample.model_view);
    const glm::dvec3 given(sample.object_tangent);
    const glm::dvec3 tangent = matrix * given;
    const double largest = glm::length(absolute(matrix) * glm::abs(given));
    const double length = glm::length(tangent);
    const double error = (length > 0 ? 3 * kUnitRoundoff * largest / length : 0) + kDirectionError;
    const double sign = glm::determinant(matrix) < 0 ? -1 : 1;
    return expected("eyeTangent", glm::dvec4(oracle::direction_of(tangent), sample.object_tangent.w * sign),
                    glm::dvec4(1), glm::dvec4(glm::dvec3(error), 0));
}

EyeNormal eye_normal(const Sample& sample) {
    const glm::dvec3 normal = sample.normal_matrix * sample.object_normal;
    const glm::dvec3 largest = absolute(sample.normal_matrix) * glm::abs(sample.object_normal);
    const double length = glm::length(normal);
    return {oracle::direction_of(normal), length > 0 ? 3 * kUnitRoundoff * glm::length(largest) / length : 0};
}

Expected expect_ray(std::size_t index, const oracle::IncidentLight& incident, const IncidentErrors& errors) {
    return expected(fmt::format("lightRays[{}]", index), glm::dvec4(incident.to_light, incident.radiance.x),
                    glm::dvec4(glm::dvec3(1), incident.unshaped.x),
                    glm::dvec4(glm::dvec3(errors.direction), errors.radiance.x));
}

Expected expect_halfway(std::size_t index, const glm::dvec3& half, double error) {
    // As a double evaluation is judged by the largest term, which is what the sum was divided by.
    const double largest = std::max(1 / std::max(glm::length(half), 1e-6), 1.0);
    return expected(fmt::format("lightsHalfways[{}]", index), oracle::direction_of(half), glm::dvec3(largest),
                    glm::dvec3(error));
}

/// The rays to the local lights and the half vectors of all lights, which hybrid shading interpolates, as the
/// vertex stage writes them at a position that is itself off by so much.
std::vector<Expected> expect_interpolated_lights(const oracle::Model& model, const oracle::Scene& scene,
                                                 const glm::dvec3& position, double position_error,
                                                 oracle::Decisions& decisions) {
    std::vector<Expected> outputs;
    const glm::dvec3 to_viewer = oracle::to_viewer(model, position);
    const double viewer = viewer_error(model, position, position_error);
    const oracle::Scene white = with_white_lights(scene);
    std::size_t number = 0;
    for (const oracle::IncidentLight& incident : oracle::incident_lights(model, white, position, decisions)) {
        const IncidentErrors errors = incident_errors(model, incident, position_error);
        if (number >= scene.directional.size())
            outputs.push_back(expect_ray(number - scene.directional.size(), incident, errors));
        const glm::dvec3 half = incident.to_light + to_viewer;
        outputs.push_back(
            expect_halfway(number, half, halfway_error(errors.direction, viewer, glm::length(half))));
        ++number;
    }
    return outputs;
}

/// The cosines of all lights as the vertex stage writes them, four to a vector and 0 behind the last, at a
/// position and a unit normal that are off by so much. Each is a dot product of two such vectors, and three
/// roundings of at most 1.
std::vector<Expected> expect_cosines(const oracle::Model& model, const oracle::Scene& scene,
                                     const oracle::SurfacePoint& vertex, double position_error,
                                     double normal_error, oracle::Decisions& decisions) {
    std::vector<Expected> outputs;
    std::size_t light = 0;
    for (const oracle::IncidentLight& incident :
         oracle::incident_lights(model, scene, vertex.position, decisions)) {
        const std::size_t component = light++ % 4;
        if (component == 0)
            outputs.push_back({fmt::format("lightCosines[{}]", outputs.size()), 4, {}, {}, {}});
        Expected& element = outputs.back();
        element.value[component] = glm::dot(vertex.normal, incident.to_light);
        element.largest[component] = 1;
        element.float_error[component] =
            normal_error + incident_errors(model, incident, position_error).direction + 3 * kUnitRoundoff;
    }
    return outputs;
}

/// What the vertex stage passes on as it is.
void add_passed_on(const Sample& sample, std::vector<Expected>& outputs) {
    outputs.push_back(expected("vertexColor", sample.surface.color));
    outputs.push_back(expected("textureCoordinate", sample.surface.texture_coordinate));
    outputs.push_back(expected("textureCoordinate1", sample.surface.texture_coordinate1));
    outputs.push_back({"flatMaterialIndex", 1, {static_cast<double>(sample.surface.material)}, {}, {}, true});
    outputs.push_back(
        {"handedness", 1, {glm::determinant(glm::dmat3(sample.model_view)) < 0 ? -1.0 : 1.0}, {}, {}, true});
}

/// The point as the fragment stage has it: no colour is negative.
oracle::SurfacePoint seen_point(const Sample& sample) {
    oracle::SurfacePoint point = sample.surface;
    point.color = glm::max(point.color, glm::dvec4(0));
    point.is_back = sample.is_front_facing != (sample.handedness > 0);
    return point;
}

std::vector<Expected> expect_vertex(const oracle::Model& model, const Sample& sample,
                                    oracle::Decisions& decisions) {
    const Placed placed = place(sample);
    const glm::dvec3 position_error = 4 * kUnitRoundoff * placed.largest;
    const EyeNormal normal = eye_normal(sample);
    std::vector<Expected> outputs = {
        expect_clip_position(sample, placed),
        expected("eyePosition", placed.value, placed.largest, position_error),
        expected("eyeNormal", normal.value, glm::dvec3(1), glm::dvec3(normal.error + kDirectionError))};
    add_passed_on(sample, outputs);
    if (model.normal_map == oracle::NormalMap::tangent || model.anisotropy == oracle::Anisotropy::brushed)
        outputs.push_back(expect_tangent(sample));
    oracle::SurfacePoint point = sample.surface;
    point.position = placed.value;
    point.normal = normal.value;
    const PointErrors errors{glm::length(position_error), normal.error};
    const auto add = [&](const std::vector<Expected>& more) {
        outputs.insert(outputs.end(), more.begin(), more.end());
    };
    if (model.shading == oracle::Shading::fragment && model.n_dot_l != oracle::NDotL::fragment)
        add(expect_cosines(model, sample.scene, point, errors.position, errors.normal + kDirectionError,
                           decisions));
    if (model.shading == oracle::Shading::hybrid)
        add(expect_interpolated_lights(model, sample.scene, placed.value, errors.position, decisions));
    if (model.is_per_fragment()) return outputs;
    const bool is_flat = model.shading == oracle::Shading::flat;
    for (const bool is_back : {false, true}) {
        if (is_back && model.sides == oracle::Sides::one) break;
        point.is_back = is_back;
        const oracle::Radiance radiance = oracle::lit_radiance(model, sample.scene, point, decisions);
        const std::string front = is_flat ? "flatRadiance" : "litRadiance";
        const std::string back = is_flat ? "flatBackRadiance" : "backRadiance";
        outputs.push_back(expected(is_back ? back : front, radiance.value, radiance.largest,
                                   radiance_error(model, sample.scene, point, radiance, errors)));
        outputs.back().is_flat = is_flat;
    }
    return outputs;
}

Expected expect_color(const oracle::Model& model, const Sample& sample, oracle::Decisions& decisions) {
    const oracle::SurfacePoint point = seen_point(sample);
    const bool is_back = model.sides != oracle::Sides::one && point.is_back;
    glm::dvec3 value = is_back ? sample.back_radiance : sample.lit_radiance;
    // Interpolation may leave radiance's range; what a face has of one vertex does not.
    if (model.shading == oracle::Shading::vertex) value = glm::max(value, glm::dvec3(0));
    glm::dvec3 largest = glm::abs(value);
    glm::dvec3 whole = largest;
    glm::dvec3 error{0};
    if (model.is_per_fragment()) {
        const oracle::Radiance radiance = oracle::lit_radiance(model, sample.scene, point, decisions);
        value = radiance.value;
        largest = radiance.largest;
        whole = radiance.physical ? radiance.of_white : largest;
        error = radiance_error(model, sample.scene, point, radiance, {});
        // Peaked highlights multiply what directions are off by: no float is further out than this.
        if (model.is_physical()) largest += error;
    }
    const oracle::Seen seen =
        oracle::seen_through_fog(model, sample.scene, sample.surface.position, value, largest, decisions);
    // What is cut off at a range is no further off than it was before.
    const glm::dvec3 held = oracle::within_range(model.output_range, seen.value);
    // Alpha is passed on, or the product of the material's and the vertices'.
    const double alpha_error = model.is_physical() ? 8 : 0;
    Expected color = expected(
        "fragmentColor", glm::dvec4(held, oracle::alpha_of(model, sample.scene, point)),
        glm::dvec4(seen.largest, alpha_error),
        glm::dvec4(fog_error(model, sample.scene, seen, value, error, 0), alpha_error * kUnitRoundoff));
    if (model.fog != oracle::Fog::none) whole += sample.scene.fog.color;
    for (int channel = 0; channel < 3; ++channel)
        color.whole[static_cast<std::size_t>(channel)] = whole[channel];
    return color;
}

std::vector<Expected> expect_fragment(const oracle::Model& model, const Sample& sample,
                                      oracle::Decisions& decisions) {
    const bool is_cut = oracle::is_cut_out(model, sample.scene, seen_point(sample), decisions);
    std::vector<Expected> outputs = {{std::string(kDiscard), 1, {is_cut ? 1.0 : 0.0}, {}, {}}};
    if (is_cut) return outputs;
    outputs.push_back(expect_color(model, sample, decisions));
    if (const auto depth = oracle::written_depth(model, sample.scene, sample.depth)) {
        // One sum of two numbers of at most 1 each.
        outputs.push_back({"gl_FragDepth", 1, {*depth}, {2}, {2 * kUnitRoundoff}});
    }
    return outputs;
}

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += fmt::format("{:<25.17g}", number);
    return text.erase(text.find_last_not_of(' ') + 1);
}

}  // namespace

std::vector<Expected> expect(const oracle::Model& model, StageKind stage, const Sample& sample,
                             oracle::Decisions& decisions) {
    return stage == StageKind::vertex ? expect_vertex(model, sample, decisions)
                                      : expect_fragment(model, sample, decisions);
}

std::optional<std::vector<Answer>> ask_oracle(const Family& family, const Key& key, StageKind stage,
                                              const evaluate::Program& program,
                                              const evaluate::Invocations& invocation) {
    const auto model = oracle::model_of(family, key);
    const std::optional<Sample> sample = sample_of(program, invocation);
    if (!model || !sample) return std::nullopt;
    std::vector<Answer> answers;
    oracle::Decisions decisions;
    oracle::Decisions float_decisions;
    const std::vector<Expected> of_floats = expect(*model, stage, rounded_to_float(*sample), float_decisions);
    for (const Expected& expected : expect(*model, stage, *sample, decisions)) {
        const bool is_there = std::ranges::count(program.outputs, expected.output, &evaluate::Port::name) > 0;
        if (!is_there) continue;
        Answer& answer = answers.emplace_back(Answer{
            expected.output, {expected.value.begin(), expected.value.begin() + expected.components}, {}});
        const auto rounded =
            std::ranges::find(of_floats, expected.output, [](const Expected& one) { return one.output; });
        for (std::size_t c = 0; c < expected.components; ++c)
            answer.float_error.push_back(rounded == of_floats.end()
                                             ? expected.float_error[c]
                                             : rounded->float_error[c] +
                                                   std::abs(rounded->value[c] - expected.value[c]));
    }
    return answers;
}

std::string to_text(const std::vector<Answer>& answers) {
    std::string text;
    for (const Answer& answer : answers)
        text += fmt::format("{} as the oracle has it\n  exact       {}\n  fp32 bound  {}\n", answer.output,
                            numbers_text(answer.value), numbers_text(answer.float_error));
    return text;
}

}  // namespace gobo::verify
