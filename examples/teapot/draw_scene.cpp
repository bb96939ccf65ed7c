#include "draw_scene.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace teapot {
namespace {

/// What this application knows of a draw, beside its look.
struct PartState {
    int directional = 0;
    int point = 0;
    int spot = 0;
    lit::Specular specular = lit::Specular::none;
    lit::Fog fog = lit::Fog::none;
};

/// 1 - cos(angle): how lit takes the half angles of a cone.
float one_minus_cosine(float angle) {
    const float half = std::sin(angle / 2);
    return 2 * half * half;
}

/// The lights in eye space, as lit's blocks hold them.
struct LightBlocks {
    lit::DirectionalLights directional{};
    lit::PointLights point{};
    lit::SpotLights spot{};
    PartState counts;
};

void add(const Light& light, const glm::mat4& view, LightBlocks& blocks) {
    const glm::vec4 position = view * glm::vec4(light.position, 1);
    const glm::vec3 shines_along = glm::mat3(view) * light.shines_along;
    switch (light.kind) {
        case Light::Kind::directional: {
            lit::DirectionalLight& to = blocks.directional.lights[blocks.counts.directional++];
            to.direction = -shines_along;
            to.color = light.color;
            return;
        }
        case Light::Kind::point: {
            lit::PointLight& to = blocks.point.lights[blocks.counts.point++];
            to.position = position;
            to.color = light.color;
            to.attenuation = light.attenuation;
            return;
        }
        case Light::Kind::spot: {
            lit::SpotLight& to = blocks.spot.lights[blocks.counts.spot++];
            to.position = position;
            to.axis = shines_along;
            to.color = light.color;
            to.attenuation = light.attenuation;
            to.exponent = light.exponent;
            to.innerOneMinusCosine = one_minus_cosine(light.inner_angle);
            to.outerOneMinusCosine = one_minus_cosine(light.outer_angle);
        }
    }
}

/// Whether fog reaches any of it: linear fog begins at a distance.
bool is_fogged(const Scene& scene, const Part& part) {
    if (scene.look.fog != lit::Fog::linear) return true;
    const glm::mat4 to_eye = scene.view * part.model;
    return std::any_of(part.mesh.vertices.begin(), part.mesh.vertices.end(), [&](const Vertex& vertex) {
        return glm::length(glm::vec3(to_eye * glm::vec4(vertex.position, 1))) > scene.fog.start;
    });
}

/// What glows of itself and gives back no light pays for none.
PartState state_of(const Scene& scene, const Part& part, const PartState& lights) {
    const bool shines = part.material.specular != glm::vec3(0);
    PartState state;
    if (shines || part.material.diffuse != glm::vec3(0)) state = lights;
    state.specular = shines ? scene.look.specular : lit::Specular::none;
    state.fog = is_fogged(scene, part) ? scene.look.fog : lit::Fog::none;
    return state;
}

lit::Transform transform(const Scene& scene, const glm::mat4& model, float aspect) {
    lit::Transform transform{};
    const glm::mat4 model_view = scene.view * model;
    transform.modelView = model_view;
    transform.projection = glm::perspective(scene.vertical_angle, aspect, scene.near_plane, scene.far_plane);
    transform.normalMatrix = glm::inverseTranspose(glm::mat3(model_view));
    return transform;
}

}  // namespace

std::set<std::string> draw(Renderer& renderer, const Scene& scene, float aspect) {
    LightBlocks blocks;
    for (const Light& light : scene.lights) add(light, scene.view, blocks);
    renderer.set(lit::Ambient{scene.ambient, {}});
    renderer.set(blocks.directional);
    renderer.set(blocks.point);
    renderer.set(blocks.spot);
    renderer.set(scene.fog);
    renderer.set(scene.toon);
    renderer.clear(scene.background);
    std::set<std::string> keys;
    for (const Part& part : scene.parts) {
        const lit::Key key = lit::select(scene.look, state_of(scene, part, blocks.counts));
        renderer.set(transform(scene, part.model, aspect));
        renderer.set(part.material);
        renderer.draw(part.mesh, key);
        keys.insert(lit::key_text(key));
    }
    return keys;
}

}  // namespace teapot
