// An application as it was written when lit had lights, fog and one material. It must compile unchanged for
// ever.
#include <cstdio>

#include "lit.hpp"

namespace {

lit::Key spot_in_fog() {
    lit::Key key;
    key.directional = 1;
    key.point = 1;
    key.spot = 1;
    key.specular = lit::Specular::blinn;
    key.fog = lit::Fog::linear;
    return key;
}

lit::DirectionalLights moon() {
    lit::DirectionalLights moon{};
    moon.lights[0].direction = glm::vec3(0, 1, 0);
    moon.lights[0].color = glm::vec3(0.26F, 0.46F, 0.95F);
    return moon;
}

lit::PointLights lamp() {
    lit::PointLights lamp{};
    lamp.lights[0].position = glm::vec4(2.0F, 0.4F, 1.9F, 1);
    lamp.lights[0].color = glm::vec3(4.2F, 1.7F, 0.45F);
    lamp.lights[0].attenuation = glm::vec3(0.25F, 0, 1);
    return lamp;
}

lit::SpotLights spot() {
    lit::SpotLights spot{};
    lit::SpotLight& light = spot.lights[0];
    light.position = glm::vec4(2.6F, 7.0F, 3.4F, 1);
    light.axis = glm::vec3(0, -1, 0);
    light.color = glm::vec3(1, 0.93F, 0.80F);
    light.attenuation = glm::vec3(1, 0, 0);
    light.exponent = 6;
    light.innerOneMinusCosine = 0.034F;
    light.outerOneMinusCosine = 0.055F;
    return spot;
}

lit::Fog_block mist() {
    lit::Fog_block mist{};
    mist.color = glm::vec3(0.012F, 0.022F, 0.045F);
    mist.density = 0.075F;
    mist.start = 8;
    mist.end = 17;
    return mist;
}

lit::Material porcelain() {
    lit::Material material{};
    material.ambient = glm::vec3(0.80F, 0.78F, 0.74F);
    material.diffuse = material.ambient;
    material.specular = glm::vec3(0.9F);
    material.strength = 1;
    material.shininess = 90;
    material.emission = glm::vec3(0);
    return material;
}

lit::Transform transform() {
    lit::Transform transform{};
    transform.modelView = glm::mat4(1);
    transform.projection = glm::mat4(1);
    transform.normalMatrix = glm::mat3(1);
    return transform;
}

/// The application's own state of a draw, whose members are named after features.
struct Draw {
    int point = 0;
    int directional = 1;
    lit::Diffuse diffuse = lit::Diffuse::toon;
    lit::Fog fog = lit::Fog::none;
    lit::Shading shading = lit::Shading::fragment;
};

template <class Block>
bool is_bound(const Block& block) {
    return Block::binding >= 0 && Block::size == sizeof block;
}

}  // namespace

int main() {
    const lit::Permutation* lit_in_fog = lit::find(spot_in_fog());
    const lit::Permutation* toon = lit::find(lit::select(Draw{}));
    if (lit_in_fog == nullptr || toon == nullptr) {
        std::puts(lit::describe_missing(lit_in_fog == nullptr ? spot_in_fog() : lit::select(Draw{})).c_str());
        return 1;
    }
    const bool fine =
        is_bound(moon()) && is_bound(lamp()) && is_bound(spot()) && is_bound(mist()) &&
        is_bound(porcelain()) && is_bound(transform()) && is_bound(lit::Toon{4, {}}) &&
        is_bound(lit::Ambient{glm::vec3(0.030F, 0.040F, 0.065F), {}}) &&
        lit::key_text(lit_in_fog->key()) == "directional=1 fog=linear point=1 specular=blinn spot=1";
    if (!fine) std::puts("a block has no place, or a key another text");
    return fine ? 0 : 1;
}
