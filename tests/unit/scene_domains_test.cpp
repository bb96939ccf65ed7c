// What a scene holds of a family's domains.
#include "scene/scene_domains.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_support.hpp"

namespace gobo::scene {
namespace {

Domain domain_of(const std::string& name, double low, double high, std::vector<double> also = {}) {
    Domain domain;
    domain.name = name;
    domain.low = low;
    domain.high = high;
    domain.also = std::move(also);
    return domain;
}

/// "Fog.start [2, 3] or 0", of every domain that the patched scene says something of.
std::vector<std::string> held_by(std::string_view patch) {
    Domain direction = domain_of("DirectionalLights.lights[].direction", 0.999999, 1.000001, {0});
    direction.of_length = true;
    const std::vector<Domain> of_family = {
        domain_of("Material.shininess", 0, 1e6),
        domain_of("Material.emission", 0, 1e5),
        domain_of("Fog.start", 1e-6, 1e6, {0}),
        domain_of("Fog.density", 1e-6, 1e3, {0}),
        domain_of("PointLights.lights[].position", -1e6, 1e6),
        domain_of("PointLights.lights[].color", 0, 1e5),
        domain_of("PointLights.lights[].attenuation", 1e-6, 1e3, {0}),
        domain_of("SpotLights.lights[].exponent", 0, 1e6),
        direction,
    };
    const Scene scene = read_patched(patch);
    std::vector<std::string> texts;
    for (const Domain& domain :
         domains_of_scene(scene, required_effects(scene, eye_of_cameras(scene), {}), of_family)) {
        EXPECT_EQ(domain.place.file, "quad.gltf");
        texts.push_back(fmt::format("{} [{}, {}]", domain.name, domain.low, domain.high));
        for (const double also : domain.also) texts.back() += fmt::format(" or {}", also);
    }
    return texts;
}

TEST(SceneDomains, AreOfMaterialsAndLightsButNoPlaces) {
    EXPECT_THAT(held_by("[]"), testing::ElementsAre("Material.shininess [30, 30]", "Material.emission [0, 0]",
                                                    "PointLights.lights[].color [1, 1]",
                                                    "PointLights.lights[].attenuation [1, 1] or 0"));
}

TEST(SceneDomains, HoldWhatFloatsReadAs) {
    EXPECT_THAT(held_by(R"([{"op": "add", "path": "/materials", "value": [{"emissiveFactor": [0.1, 0.7, 0]}]},
                            {"op": "add", "path": "/meshes/0/primitives/0/material", "value": 0}])"),
                testing::Contains("Material.emission [0, 0.7]"));
}

TEST(SceneDomains, KeepADullMaterialsShininessApart) {
    EXPECT_THAT(held_by(R"([{"op": "add", "path": "/materials", "value": [
                       {"pbrMetallicRoughness": {"roughnessFactor": 0.5, "metallicFactor": 0}},
                       {"pbrMetallicRoughness": {"roughnessFactor": 1, "metallicFactor": 0},
                        "extras": {"gobo": {"specular": "none"}}}]},
                    {"op": "add", "path": "/meshes/0/primitives/0/material", "value": 0},
                    {"op": "copy", "from": "/meshes/0/primitives/0", "path": "/meshes/0/primitives/-"},
                    {"op": "replace", "path": "/meshes/0/primitives/1/material", "value": 1}])"),
                testing::Contains("Material.shininess [30, 30] or 0"));
}

}  // namespace
}  // namespace gobo::scene
