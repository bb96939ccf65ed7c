#include "lab/verify/sample_effects.hpp"

#include <algorithm>
#include <cmath>

#include "lab/oracle/oracle.hpp"
#include "lab/oracle/reflectance_extensions.hpp"

namespace gobo::verify {
namespace {

/// A bright mean, so that the polynomial is seldom negative, and sides that make it so now and then.
void fill_harmonics(Random& random, oracle::HarmonicsLight& light) {
    light.to_probe = glm::dmat3(random.rotation(0, 6.28));
    light.coefficients[0] = random.components(0, 2);
    for (std::size_t i = 1; i < light.coefficients.size(); ++i)
        light.coefficients[i] = random.components(-0.7, 0.7);
    light.scale = random.across(0.1, 2);
}

void fill(Random& random, oracle::ImageLight& light) {
    light.color = random.components(0, 1);
    light.weight = random.one_in(8) ? static_cast<double>(random.whole(0, 1)) : random.unit();
    light.to_map = glm::dmat3(random.rotation(0, 6.28));
    light.map.mean = random.components(0.5, 2);
    for (int column = 0; column < 3; ++column) light.map.slope[column] = random.components(-0.25, 0.25);
}

glm::dvec3 shortened(const glm::dvec3& direction, Random& random) {
    return direction * random.between(0.3, 1);
}

/// Sets a row of the matrix so that the position gives `value`; its terms are a few times 1.
void set_row(glm::dmat4& matrix, int row, const glm::dvec3& position, double value, Random& random) {
    const glm::dvec3 slope = random.vector(0.2, 2) / glm::length(position);
    for (int column = 0; column < 3; ++column) matrix[column][row] = slope[column];
    matrix[3][row] = value - glm::dot(slope, position);
}

/// Pictures of every colour, evenly changing; now and then one of the undisturbed normal, or of none at all.
void fill_pictures(Random& random, Sample& sample) {
    const auto even = [&](double low, double high) {
        const double w = random.between(low, high);
        return glm::dvec4(random.components(low, high), w);
    };
    for (oracle::EvenPicture& picture : sample.scene.pictures)
        picture = {even(0.2, 0.8), even(-0.02, 0.02), even(-0.02, 0.02)};
    oracle::EvenPicture& normals = sample.scene.pictures[static_cast<std::size_t>(oracle::MapKind::normal)];
    normals.even.z = random.between(0.6, 1);
    if (random.one_in(8))
        normals = {{0.5, 0.5, random.one_in(16) ? 0.5 : 1, 1}, glm::dvec4(0), glm::dvec4(0)};
    for (oracle::TexturePlacement& placement : sample.scene.placements)
        placement = {even(-2, 2), {random.between(-1, 1), random.between(-1, 1)}, random.whole(0, 1)};
    oracle::SurfacePoint& point = sample.surface;
    point.texture_coordinate = {random.between(-2, 2), random.between(-2, 2)};
    point.texture_coordinate1 = {random.between(-2, 2), random.between(-2, 2)};
    const double sign = random.one_in(2) ? -1 : 1;
    const double tangent_length = random.between(0.3, 1);
    point.tangent = {random.direction() * tangent_length, sign};
    sample.object_tangent = {random.direction(), sign};
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
    const glm::dvec3 light = position + random.vector(0.5, 3) * glm::length(position);
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

void fill_environment(const oracle::Model& model, Random& random, oracle::Scene& scene) {
    if (model.ambient == oracle::Ambient::hemisphere)
        scene.hemisphere = {random.direction(), random.components(0, 2), random.components(0, 2)};
    if (model.ambient == oracle::Ambient::spherical_harmonics) fill_harmonics(random, scene.harmonics);
    if (model.light_ambient == oracle::LightAmbient::each)
        for (int i = 0; i < model.lights(); ++i) scene.light_ambients.push_back(random.components(0, 0.5));
    if (model.diffuse != oracle::Diffuse::toon_thresholds) return;
    for (double& threshold : scene.toon_thresholds) threshold = random.unit();
    std::sort(scene.toon_thresholds.rbegin(), scene.toon_thresholds.rend());
    if (random.one_in(8)) scene.toon_thresholds[2] = 0;
    for (double& tone : scene.toon_tones) tone = random.one_in(8) ? 0 : random.unit();
}

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

}  // namespace

/// The scene with local lights that are white and 1 bright: what arrives of them is their attenuation.
/// Incident lights refer to the lights of their scene.
oracle::Scene with_white_lights(oracle::Scene scene) {
    for (oracle::PointLight& light : scene.point) light.color = glm::dvec3(1);
    for (oracle::SpotLight& light : scene.spot) light.color = glm::dvec3(1);
    return scene;
}

void choose_side(const oracle::Model& model, StageKind stage, Random& random, Sample& sample) {
    if (model.sides == oracle::Sides::one) return;
    sample.handedness = random.one_in(2) ? -1 : 1;
    if (stage == StageKind::vertex) {
        if (sample.handedness > 0) return;
        sample.model_view[0] = -sample.model_view[0];  // and the normal's matrix, its inverse transpose
        sample.normal_matrix[0] = -sample.normal_matrix[0];
        sample.object_position.x = -sample.object_position.x;
        sample.object_normal.x = -sample.object_normal.x;
        return;
    }
    sample.is_front_facing = random.one_in(2);
    sample.surface.is_back = sample.is_front_facing != (sample.handedness > 0);
    if (sample.surface.is_back)
        sample.surface.normal = -sample.surface.normal;  // lights stand before what is seen
    sample.back_radiance = random.components(-0.1, 4);
}

void fill_surface(const oracle::Model& model, StageKind stage, Random& random, Sample& sample) {
    const double beyond =
        stage == StageKind::fragment ? 0.05 : 0;  // interpolation may leave the range a little
    if (model.vertex_color == oracle::VertexColor::modulate)
        sample.surface.color = {random.components(-beyond, 1), random.between(-beyond, 1)};
    if (model.cutout == oracle::Cutout::threshold) {
        sample.surface.texture_coordinate = {random.between(-2, 2), random.between(-2, 2)};
        sample.surface.opacity = random.unit();
        sample.scene.cutout_threshold = random.one_in(8) ? 0 : random.between(0, 0.8);
    }
    if (model.material == oracle::MaterialChoice::array) sample.surface.material = random.whole(-2, 16);
}

void fill_metallic_roughness(Random& random, Sample& sample) {
    oracle::Material& material = sample.scene.material;
    const auto factor = [&] { return random.one_in(4) ? random.whole(0, 1) : random.unit(); };
    material.base_color = {random.components(0, 1), random.unit()};
    material.metallic = factor();
    material.roughness = random.one_in(4) ? random.across(0.01, 0.2) : factor();
    material.dielectric = random.one_in(2) ? glm::dvec3(0.04) : random.components(0, 1);
    material.dielectric_edge = random.one_in(2) ? 1 : factor();
    material.normal_scale = random.one_in(2) ? 1 : random.between(-2, 2);
    material.occlusion_strength = factor();
    material.clearcoat = factor();
    material.clearcoat_roughness = factor();
    material.sheen_color = random.components(0, 1);
    material.sheen_roughness = factor();
    material.anisotropy = factor();
    const double brush = random.between(0, 6.28);
    material.anisotropy_direction = {std::cos(brush), std::sin(brush)};
    fill_pictures(random, sample);
    if (sample.model.extensions.empty()) return;
    for (const oracle::ExtensionNumber& number : oracle::extension_numbers()) {
        const double share = factor();
        sample.scene.extension_numbers.push_back(number.low + share * (number.high - number.low));
    }
}

void vary_surface(std::size_t vertex, Sample& sample) {
    Random random(vertex);
    sample.surface.color = {random.components(0, 1), random.unit()};
    sample.surface.texture_coordinate = {random.between(-2, 2), random.between(-2, 2)};
    sample.surface.material = random.whole(-2, 16);
    if (!sample.model.is_physical()) return;
    sample.surface.texture_coordinate1 = {random.between(-2, 2), random.between(-2, 2)};
    // Any direction along the surface that changes little from vertex to vertex.
    const glm::dvec3 along = glm::cross(sample.object_normal, glm::dvec3(0.3, 1, 0.2));
    sample.object_tangent = {oracle::direction_of(along), sample.object_tangent.w};
}

void interpolate_lights(const oracle::Model& model, const oracle::Scene& scene, Random& random,
                        oracle::SurfacePoint& point) {
    oracle::Decisions decisions;
    if (model.shading == oracle::Shading::hybrid) {
        const glm::dvec3 to_viewer = oracle::to_viewer(model, point.position);
        const oracle::Scene white = with_white_lights(scene);
        std::size_t number = 0;
        for (const oracle::IncidentLight& incident :
             oracle::incident_lights(model, white, point.position, decisions)) {
            if (number++ >= scene.directional.size()) {
                const double attenuation = incident.radiance.x * random.between(0.9, 1.1);
                const double factor = random.one_in(16) ? -0.01 : 1;
                point.rays.emplace_back(shortened(incident.to_light, random), factor * attenuation);
            }
            point.halfways.push_back(shortened(oracle::direction_of(incident.to_light + to_viewer), random));
        }
    }
    if (model.n_dot_l != oracle::NDotL::vertex) return;
    const glm::dvec3 normal = oracle::direction_of(point.normal);
    for (const oracle::IncidentLight& incident :
         oracle::incident_lights(model, scene, point.position, decisions))
        point.cosines.push_back(glm::dot(normal, incident.to_light) * random.between(0.7, 1));
}

void fill_effects(const oracle::Model& model, Random& random, Sample& sample) {
    add_shadows(model, random, sample);
    fill_environment(model, random, sample.scene);
    const bool uses_table = model.environment_brdf == oracle::EnvironmentBrdf::table;
    if (!model.looks_up_images() && !uses_table) return;
    fill(random, sample.scene.image_light);
    fill(random, sample.scene.reflection);
    if (!model.is_physical()) return;
    sample.scene.reflection.roughest_level = random.whole(0, 8);
    const double mirrored = random.between(0.3, 1);
    const double at_edge = mirrored * random.unit();
    sample.scene.environment_brdf = {mirrored - at_edge, at_edge};
}

}  // namespace gobo::verify
