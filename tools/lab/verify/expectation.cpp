#include "lab/verify/expectation.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lab/oracle/oracle.hpp"
#include "lab/verify/cosines.hpp"
#include "lab/verify/hybrid.hpp"
#include "lab/verify/rounding.hpp"

namespace gobo::verify {
namespace {

Expected expected(std::string output, const glm::dvec3& value, const glm::dvec3& largest,
                  const glm::dvec3& float_error) {
    Expected result{std::move(output), 3, {}, {}, {}};
    for (int i = 0; i < 3; ++i) {
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
    Expected result{"gl_Position", 4, {}, {}, {}};
    for (int row = 0; row < 4; ++row) {
        const auto index = static_cast<std::size_t>(row);
        const double last = sample.projection[3][row];
        result.value[index] = last;
        result.largest[index] = std::abs(last);
        for (int column = 0; column < 3; ++column) {
            const double factor = sample.projection[column][row];
            result.value[index] += factor * placed.value[column];
            result.largest[index] += std::abs(factor) * placed.largest[column];
        }
        result.float_error[index] = 8 * kUnitRoundoff * result.largest[index];  // two transformations
    }
    return result;
}

/// The unit normal in eye space, and its relative error: three roundings of the terms' sum before it is made
/// unit. A sum of three components' errors is at most sqrt(3) times the largest.
struct EyeNormal {
    glm::dvec3 value{0};
    double error = 0;
};

EyeNormal eye_normal(const Sample& sample) {
    const glm::dvec3 normal = sample.normal_matrix * sample.object_normal;
    const glm::dvec3 largest = absolute(sample.normal_matrix) * glm::abs(sample.object_normal);
    const double length = glm::length(normal);
    return {oracle::direction_of(normal), length > 0 ? 3 * kUnitRoundoff * glm::length(largest) / length : 0};
}

/// What the vertex stage hands on as it is.
void add_handed_on(const Sample& sample, std::vector<Expected>& outputs) {
    const glm::dvec4& color = sample.surface.color;
    const glm::dvec2& uv = sample.texture_coordinate;
    outputs.push_back({"vertexColor", 4, {color.r, color.g, color.b, color.a}, {}, {}});
    outputs.push_back({"textureCoordinate", 2, {uv.x, uv.y}, {}, {}});
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
    add_handed_on(sample, outputs);
    oracle::SurfacePoint point = sample.surface;
    point.position = placed.value;
    point.normal = normal.value;
    const PointErrors errors{glm::length(position_error), normal.error};
    if (model.shading == oracle::Shading::fragment) {
        if (model.n_dot_l == oracle::NDotL::fragment) return outputs;
        for (Expected& intensity : expect_cosines(model, sample.scene, point, errors.position,
                                                  errors.normal + kDirectionError, decisions))
            outputs.push_back(std::move(intensity));
        return outputs;
    }
    if (model.shading == oracle::Shading::hybrid) {
        for (Expected& handed_on :
             expect_handed_on(model, sample.scene, placed.value, errors.position, decisions))
            outputs.push_back(std::move(handed_on));
        return outputs;
    }
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
    glm::dvec3 error{0};
    if (model.is_per_fragment()) {
        const oracle::Radiance radiance = oracle::lit_radiance(model, sample.scene, point, decisions);
        value = radiance.value;
        largest = radiance.largest;
        error = radiance_error(model, sample.scene, point, radiance, {});
    }
    const oracle::Seen seen =
        oracle::seen_through_fog(model, sample.scene, sample.surface.position, value, largest, decisions);
    // What is cut off at a range is no further off than it was before.
    const glm::dvec3 held = oracle::within_range(model.output_range, seen.value);
    Expected color =
        expected("fragmentColor", held, seen.largest, fog_error(model, sample.scene, seen, value, error, 0));
    color.components = 4;
    color.value[3] = oracle::alpha_of(model, point);
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

}  // namespace

std::vector<Expected> expect(const oracle::Model& model, StageKind stage, const Sample& sample,
                             oracle::Decisions& decisions) {
    return stage == StageKind::vertex ? expect_vertex(model, sample, decisions)
                                      : expect_fragment(model, sample, decisions);
}

}  // namespace gobo::verify
