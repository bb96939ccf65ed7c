#include "scene.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace teapot {
namespace {

const glm::vec3 night(0.012f, 0.022f, 0.045f);
const glm::vec3 lamp_position(2.0f, 0.40f, 1.9f);
const glm::vec3 lamp_color(4.2f, 1.7f, 0.45f);

glm::mat4 camera() {
    return glm::lookAt(glm::vec3(-1.0f, 2.9f, 8.2f), glm::vec3(0.12f, 0.80f, 0), glm::vec3(0, 1, 0));
}

/// 1 - cos(angle): how lit takes the half angles of a cone.
float versine(float degrees) {
    const float half = std::sin(glm::radians(degrees) / 2);
    return 2 * half * half;
}

lit::DirectionalLights moon(const glm::mat4& view) {
    lit::DirectionalLights moon{};
    moon.lights[0].direction = glm::mat3(view) * glm::normalize(glm::vec3(-0.85f, 0.42f, 0.10f));
    moon.lights[0].color = glm::vec3(0.26f, 0.46f, 0.95f);
    return moon;
}

lit::PointLights lamp(const glm::mat4& view) {
    lit::PointLights lamp{};
    lamp.lights[0].position = view * glm::vec4(lamp_position, 1);
    lamp.lights[0].color = lamp_color;
    lamp.lights[0].attenuation = glm::vec3(0.25f, 0, 1);
    return lamp;
}

lit::SpotLights spot(const glm::mat4& view) {
    const glm::vec3 position(2.6f, 7.0f, 3.4f);
    const glm::vec3 target(0, 0.5f, 0);
    lit::SpotLights spot{};
    lit::SpotLight& light = spot.lights[0];
    light.position = view * glm::vec4(position, 1);
    light.axis = glm::mat3(view) * glm::normalize(target - position);
    light.color = 1.55f * glm::vec3(1, 0.93f, 0.80f);
    light.attenuation = glm::vec3(1, 0, 0);
    light.exponent = 6;
    light.innerVersine = versine(15);
    light.outerVersine = versine(19);
    return spot;
}

lit::Fog_block mist() {
    lit::Fog_block mist{};
    mist.color = night;
    mist.density = 0.075f;
    mist.near = 8;
    mist.far = 17;
    return mist;
}

lit::Material matte(glm::vec3 color) {
    lit::Material material{};
    material.ambient = color;
    material.diffuse = color;
    material.specular = glm::vec3(0.10f);
    material.strength = 1;
    material.shininess = 24;
    return material;
}

lit::Material porcelain() {
    lit::Material material = matte(glm::vec3(0.80f, 0.78f, 0.74f));
    material.specular = glm::vec3(0.9f);
    material.shininess = 90;
    return material;
}

lit::Material glowing(glm::vec3 radiance) {
    lit::Material material{};
    material.emission = radiance;
    return material;
}

lit::Transform transform(const glm::mat4& model_view, float aspect) {
    lit::Transform transform{};
    transform.modelView = model_view;
    transform.projection = glm::perspective(glm::radians(27.0f), aspect, 0.5f, 60.0f);
    transform.normalMatrix = glm::inverseTranspose(glm::mat3(model_view));
    return transform;
}

}  // namespace

Scene::Scene(const std::string& teapot_file)
    : teapot_(read_obj(teapot_file, 2)),
      light_tiles_(floor_tiles(false)),
      dark_tiles_(floor_tiles(true)),
      lamp_(sphere(0.12f)) {}

void Scene::draw(Renderer& renderer, const lit::Key& key, float aspect) const {
    const glm::mat4 view = camera();
    renderer.set(lit::Ambient{glm::vec3(0.030f, 0.040f, 0.065f), {}});
    renderer.set(moon(view));
    renderer.set(lamp(view));
    renderer.set(spot(view));
    renderer.set(mist());
    renderer.set(lit::Toon{4, {}});
    renderer.clear(night);

    renderer.set(transform(view, aspect));
    renderer.set(matte(glm::vec3(0.36f, 0.38f, 0.42f)));
    renderer.draw(light_tiles_, key);
    renderer.set(matte(glm::vec3(0.09f, 0.10f, 0.13f)));
    renderer.draw(dark_tiles_, key);

    const glm::mat4 turned = glm::rotate(view, glm::radians(25.0f), glm::vec3(0, 1, 0));
    renderer.set(transform(turned, aspect));
    renderer.set(porcelain());
    renderer.draw(teapot_, key);

    if (key.point == 0) return;
    lit::Key unlit;
    unlit.fog = key.fog;
    renderer.set(transform(glm::translate(view, lamp_position), aspect));
    renderer.set(glowing(lamp_color));
    renderer.draw(lamp_, unlit);
}

}  // namespace teapot
