#include "lab/verify/shadow_sample.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gobo::verify {
namespace {

/// Sets a row of the matrix so that the position gives `value`; its terms are a few times 1.
void set_row(glm::dmat4& matrix, int row, const glm::dvec3& position, double value, Random& random) {
    const glm::dvec3 slope = random.direction() * random.across(0.2, 2) / glm::length(position);
    for (int column = 0; column < 3; ++column) matrix[column][row] = slope[column];
    matrix[3][row] = value - glm::dot(slope, position);
}

/// A light before which the point lies at `reference` depth, somewhere on the map or a little beside it; one
/// in sixteen has the point behind it.
void place_map(oracle::Shadow& shadow, bool is_spot, double reference, const glm::dvec3& position,
               Random& random) {
    double w = is_spot ? random.across(0.3, 3) : 1;
    if (is_spot && random.one_in(16)) w = -w;
    const bool is_beside = random.one_in(8);
    const double low = is_beside ? -0.5 : 0;
    const double high = is_beside ? 1.5 : 1;
    set_row(shadow.to_map, 0, position, w * random.between(low, high), random);
    set_row(shadow.to_map, 1, position, w * random.between(low, high), random);
    set_row(shadow.to_map, 2, position, w * reference, random);
    if (is_spot) set_row(shadow.to_map, 3, position, w, random);
}

/// A cube around a light, whose faces are turned any way, with its planes so that the depth is `reference`.
void place_cube(oracle::Shadow& shadow, double reference, const glm::dvec3& position, Random& random) {
    const glm::dvec3 x = random.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
    const glm::dmat3 turn = glm::transpose(glm::dmat3(x, y, glm::cross(x, y)));
    const glm::dvec3 light = position + random.direction() * random.across(0.5, 3) * glm::length(position);
    shadow.to_map = glm::dmat4(turn);
    shadow.to_map[3] = glm::dvec4(turn * -light, 1);
    const glm::dvec3 ray = glm::abs(turn * (position - light));
    const double w = std::max({ray.x, ray.y, ray.z});
    const double near = w * random.between(0.05, 0.5);
    shadow.depth_scale = reference / (1 - near / w);
    shadow.depth_shift = -shadow.depth_scale * near;
    shadow.spread = random.between(0.3, 0.5);
}

/// One layer in eight all in the light, one in eight all in the shadow.
void fill_layer(oracle::DepthMaps& maps, int layer, double reference, Random& random) {
    const int kind = random.whole(0, 7);
    const int texels = maps.width * maps.height;
    for (int i = 0; i < texels; ++i) {
        const double distance = random.between(0.001, 0.3);
        const bool is_nearer = kind == 1 || (kind > 1 && random.one_in(2));
        maps.depths[static_cast<std::size_t>(layer * texels + i)] =
            std::clamp(reference + (is_nearer ? -distance : distance), 0.0, 1.0);
    }
}

}  // namespace

void add_shadows(const oracle::Model& model, Random& random, Sample& sample) {
    if (model.shadows() == 0) return;
    oracle::DepthMaps& maps = sample.scene.maps;
    maps.width = random.whole(1, 8);
    maps.height = random.whole(1, 8);
    int layer = random.whole(0, 2);
    maps.layers = layer + model.directional_shadows + model.spot_shadows + 6 * model.point_shadows;
    maps.depths.assign(static_cast<std::size_t>(maps.width * maps.height * maps.layers), 0.5);
    const int first_cube = model.directional_shadows + model.spot_shadows;
    for (int i = 0; i < model.shadows(); ++i) {
        oracle::Shadow& shadow = sample.scene.shadows.emplace_back();
        shadow.layer = layer;
        const bool is_cube = i >= first_cube;
        const double reference = random.one_in(16) ? random.between(-0.2, 1.2) : random.between(0.05, 0.95);
        if (is_cube)
            place_cube(shadow, reference, sample.surface.position, random);
        else
            place_map(shadow, i >= model.directional_shadows, reference, sample.surface.position, random);
        for (int face = 0; face < (is_cube ? 6 : 1); ++face) fill_layer(maps, layer++, reference, random);
    }
}

}  // namespace gobo::verify
