#include "lab/verify/sample_surface.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace gobo::verify {
namespace {

void fill_hemisphere(Random& random, oracle::HemisphereLight& light) {
    light.up = random.direction();
    light.sky = random.components(0, 2);
    light.ground = random.components(0, 2);
}

/// A bright mean, so that the polynomial is seldom negative, and sides that make it so now and then.
void fill_harmonics(Random& random, oracle::HarmonicsLight& light) {
    light.to_probe = glm::dmat3(glm::rotate(glm::dmat4(1), random.between(0, 6.28), random.direction()));
    light.coefficients[0] = random.components(0, 2);
    for (std::size_t i = 1; i < light.coefficients.size(); ++i)
        light.coefficients[i] = random.components(-0.7, 0.7);
    light.scale = random.across(0.1, 2);
}

void to_float(double& number) {
    number = static_cast<float>(number);
}
template <glm::length_t size>
void to_float(glm::vec<size, double>& vector) {
    for (int i = 0; i < size; ++i) to_float(vector[i]);
}

void to_float(oracle::Material& material) {
    for (glm::dvec3* color : {&material.emission, &material.ambient, &material.diffuse, &material.specular})
        to_float(*color);
    to_float(material.shininess);
    to_float(material.strength);
}

void to_float(oracle::Scene& scene) {
    for (oracle::DirectionalOrPointLight& light : scene.directional_or_point) {
        to_float(light.position);
        to_float(light.color);
        to_float(light.attenuation);
    }
    for (glm::dvec3& color : scene.light_ambients) to_float(color);
    for (glm::dvec3* vector : {&scene.hemisphere.up, &scene.hemisphere.sky, &scene.hemisphere.ground})
        to_float(*vector);
    for (int column = 0; column < 3; ++column) to_float(scene.harmonics.to_probe[column]);
    for (glm::dvec3& coefficient : scene.harmonics.coefficients) to_float(coefficient);
    to_float(scene.harmonics.scale);
    for (double& number : scene.toon_thresholds) to_float(number);
    for (double& number : scene.toon_tones) to_float(number);
    for (oracle::Material& material : scene.materials) to_float(material);
    to_float(scene.cutout_threshold);
}

}  // namespace

void choose_side(const oracle::Model& model, StageKind stage, Random& random, Sample& sample) {
    if (model.sides == oracle::Sides::one) return;
    sample.handedness = random.one_in(2) ? -1 : 1;
    if (stage == StageKind::vertex) {
        if (sample.handedness > 0) return;
        sample.model_view[0] =
            -sample.model_view[0];  // the normal's matrix is the inverse transpose: as well
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
        sample.texture_coordinate = {random.between(-2, 2), random.between(-2, 2)};
        sample.surface.opacity = random.unit();
        sample.scene.cutout_threshold = random.one_in(8) ? 0 : random.between(0, 0.8);
    }
    if (model.material == oracle::MaterialChoice::array) sample.surface.material = random.whole(-2, 16);
}

void vary_surface(std::size_t vertex, Sample& sample) {
    Random random(vertex);
    sample.surface.color = {random.components(0, 1), random.unit()};
    sample.texture_coordinate = {random.between(-2, 2), random.between(-2, 2)};
    sample.surface.material = random.whole(-2, 16);
}

void fill_environment(const oracle::Model& model, Random& random, oracle::Scene& scene) {
    if (model.ambient == oracle::Ambient::hemisphere) fill_hemisphere(random, scene.hemisphere);
    if (model.ambient == oracle::Ambient::spherical_harmonics) fill_harmonics(random, scene.harmonics);
    if (model.light_ambient == oracle::LightAmbient::each)
        for (int i = 0; i < model.lights(); ++i) scene.light_ambients.push_back(random.components(0, 0.5));
    if (model.diffuse != oracle::Diffuse::toon_thresholds) return;
    for (double& threshold : scene.toon_thresholds) threshold = random.unit();
    std::sort(scene.toon_thresholds.rbegin(), scene.toon_thresholds.rend());
    if (random.one_in(8)) scene.toon_thresholds[2] = 0;
    for (double& tone : scene.toon_tones) tone = random.one_in(8) ? 0 : random.unit();
}

void round_surface(Sample& sample) {
    to_float(sample.scene);
    to_float(sample.surface.color);
    to_float(sample.surface.opacity);
    to_float(sample.back_radiance);
    to_float(sample.texture_coordinate);
}

}  // namespace gobo::verify
