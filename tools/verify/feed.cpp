#include "verify/feed.hpp"

#include <charconv>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

namespace gobo::verify {
namespace {

std::vector<double> numbers(double value) {
    return {value};
}
std::vector<double> numbers(const glm::dvec3& value) {
    return {value.x, value.y, value.z};
}
std::vector<double> numbers(const glm::dmat3& value) {
    return {glm::value_ptr(value), glm::value_ptr(value) + 9};
}
std::vector<double> numbers(const glm::dmat4& value) {
    return {glm::value_ptr(value), glm::value_ptr(value) + 16};
}
/// A point as the shaders take it: its w is 1.
std::vector<double> point_numbers(const glm::dvec3& value) {
    return {value.x, value.y, value.z, 1};
}

using Getters = std::map<std::string, Getter, std::less<>>;

Getters plain_getters() {
    return {
        {"position", [](const Sample& s) { return numbers(s.object_position); }},
        {"normal", [](const Sample& s) { return numbers(s.object_normal); }},
        {"Transform.modelView", [](const Sample& s) { return numbers(s.model_view); }},
        {"Transform.projection", [](const Sample& s) { return numbers(s.projection); }},
        {"Transform.normalMatrix", [](const Sample& s) { return numbers(s.normal_matrix); }},
        {"eyePosition", [](const Sample& s) { return numbers(s.surface.position); }},
        {"eyeNormal", [](const Sample& s) { return numbers(s.surface.normal); }},
        {"litRadiance", [](const Sample& s) { return numbers(s.lit_radiance); }},
        {"gl_FragCoord",
         [](const Sample& s) {
             return std::vector<double>{0.5, 0.5, s.depth, 1};
         }},
        {"Material.emission", [](const Sample& s) { return numbers(s.scene.material.emission); }},
        {"Material.ambient", [](const Sample& s) { return numbers(s.scene.material.ambient); }},
        {"Material.diffuse", [](const Sample& s) { return numbers(s.scene.material.diffuse); }},
        {"Material.specular", [](const Sample& s) { return numbers(s.scene.material.specular); }},
        {"Material.shininess", [](const Sample& s) { return numbers(s.scene.material.shininess); }},
        {"Material.strength", [](const Sample& s) { return numbers(s.scene.material.strength); }},
        {"Ambient.color", [](const Sample& s) { return numbers(s.scene.ambient); }},
        {"Toon.levels", [](const Sample& s) { return numbers(s.scene.toon_levels); }},
        {"Fog.color", [](const Sample& s) { return numbers(s.scene.fog.color); }},
        {"Fog.density", [](const Sample& s) { return numbers(s.scene.fog.density); }},
        {"Fog.near", [](const Sample& s) { return numbers(s.scene.fog.near); }},
        {"Fog.far", [](const Sample& s) { return numbers(s.scene.fog.far); }},
        {"DepthOffset.offset", [](const Sample& s) { return numbers(s.scene.depth_offset); }},
    };
}

template <class Light>
using LightGetter = std::vector<double> (*)(const Light&);
template <class Light>
using LightGetters = std::map<std::string, LightGetter<Light>, std::less<>>;

LightGetters<oracle::DirectionalLight> directional_getters() {
    using Light = oracle::DirectionalLight;
    return {{"direction", [](const Light& light) { return numbers(light.direction); }},
            {"color", [](const Light& light) { return numbers(light.color); }}};
}

template <class Light>
LightGetters<Light> point_getters() {
    return {{"position", [](const Light& light) { return point_numbers(light.position); }},
            {"color", [](const Light& light) { return numbers(light.color); }},
            {"attenuation", [](const Light& light) { return numbers(light.attenuation); }}};
}

LightGetters<oracle::SpotLight> spot_getters() {
    using Light = oracle::SpotLight;
    LightGetters<Light> getters = point_getters<Light>();
    getters["axis"] = [](const Light& light) { return numbers(light.axis); };
    getters["exponent"] = [](const Light& light) { return numbers(light.exponent); };
    getters["innerVersine"] = [](const Light& light) { return numbers(light.inner_versine); };
    getters["outerVersine"] = [](const Light& light) { return numbers(light.outer_versine); };
    return getters;
}

/// "PointLights.lights[2].color" after its block's name: 2 and "color".
struct LightName {
    std::size_t index = 0;
    std::string_view member;
};

std::optional<LightName> light_name(std::string_view name, std::string_view block) {
    const std::string prefix = fmt::format("{}.lights[", block);
    if (!name.starts_with(prefix)) return std::nullopt;
    name.remove_prefix(prefix.size());
    LightName result;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), result.index);
    name.remove_prefix(static_cast<std::size_t>(end - name.data()));
    if (error != std::errc() || !name.starts_with("].")) return std::nullopt;
    result.member = name.substr(2);
    return result;
}

template <class Light>
Getter light_getter(std::string_view name, std::string_view block, std::vector<Light> oracle::Scene::*lights,
                    const LightGetters<Light>& getters) {
    const auto parsed = light_name(name, block);
    if (!parsed) return {};
    const auto found = getters.find(parsed->member);
    if (found == getters.end()) return {};
    return [get = found->second, index = parsed->index, lights](const Sample& sample) {
        return get((sample.scene.*lights)[index]);
    };
}

Result<bool> feed_port(const evaluate::Port& port, std::span<const Sample> samples,
                       evaluate::Invocations& invocations) {
    const Getter get = getter_of(port.name);
    if (!get && port.name.starts_with("gl_")) return true;  // gl_InstanceID and the like: 0
    if (!get) {
        return fail(Fault::input, fmt::format("nothing is known to give '{}'", port.name),
                    "the oracle's samples must learn what it means (tools/verify/feed.cpp)");
    }
    std::vector<double>& values = invocations.values[port.name];
    values.resize(port.components * samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::vector<double> value = get(samples[i]);
        for (std::size_t c = 0; c < std::min<std::size_t>(port.components, value.size()); ++c)
            values[c * samples.size() + i] = value[c];
    }
    return true;
}

}  // namespace

Getter getter_of(const std::string& name) {
    static const Getters plain = plain_getters();
    if (const auto found = plain.find(name); found != plain.end()) return found->second;
    using oracle::Scene;
    if (Getter get = light_getter(name, "DirectionalLights", &Scene::directional, directional_getters()))
        return get;
    if (Getter get = light_getter(name, "PointLights", &Scene::point, point_getters<oracle::PointLight>()))
        return get;
    return light_getter(name, "SpotLights", &Scene::spot, spot_getters());
}

Result<evaluate::Invocations> feed(const evaluate::Program& program, std::span<const Sample> samples) {
    evaluate::Invocations invocations;
    invocations.count = samples.size();
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            if (const Result<bool> fed = feed_port(port, samples, invocations); !fed)
                return tl::unexpected(fed.error());
    return invocations;
}

}  // namespace gobo::verify
