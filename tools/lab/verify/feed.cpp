#include "lab/verify/feed.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "lab/verify/cosines.hpp"
#include "lab/verify/feed_surface.hpp"
#include "lab/verify/field_access.hpp"
#include "lab/verify/image_light_feed.hpp"
#include "lab/verify/sample_textures.hpp"
#include "lab/verify/shadow_feed.hpp"

namespace gobo::verify {
namespace {

Fields plain_fields() {
    return {
        {"position", field([](auto& s) -> auto& { return s.object_position; })},
        {"normal", field([](auto& s) -> auto& { return s.object_normal; })},
        {"Transform.modelView", field([](auto& s) -> auto& { return s.model_view; })},
        {"Transform.projection", field([](auto& s) -> auto& { return s.projection; })},
        {"Transform.normalMatrix", field([](auto& s) -> auto& { return s.normal_matrix; })},
        {"eyePosition", field([](auto& s) -> auto& { return s.surface.position; })},
        {"eyeNormal", field([](auto& s) -> auto& { return s.surface.normal; })},
        {"litRadiance", field([](auto& s) -> auto& { return s.lit_radiance; })},
        {"flatRadiance", field([](auto& s) -> auto& { return s.lit_radiance; })},
        {"gl_FragCoord",
         {[](const Sample& s) {
              return std::vector<double>{0.5, 0.5, s.depth, 1};
          },
          [](Sample& s, const std::vector<double>& values) { s.depth = values.at(2); }}},
        {"Material.emission", field([](auto& s) -> auto& { return s.scene.material.emission; })},
        {"Material.ambient", field([](auto& s) -> auto& { return s.scene.material.ambient; })},
        {"Material.diffuse", field([](auto& s) -> auto& { return s.scene.material.diffuse; })},
        {"Material.specular", field([](auto& s) -> auto& { return s.scene.material.specular; })},
        {"Material.shininess", field([](auto& s) -> auto& { return s.scene.material.shininess; })},
        {"Material.strength", field([](auto& s) -> auto& { return s.scene.material.strength; })},
        {"Ambient.color", field([](auto& s) -> auto& { return s.scene.ambient; })},
        {"Toon.levels", field([](auto& s) -> auto& { return s.scene.toon_levels; })},
        {"Fog.color", field([](auto& s) -> auto& { return s.scene.fog.color; })},
        {"Fog.density", field([](auto& s) -> auto& { return s.scene.fog.density; })},
        {"Fog.start", field([](auto& s) -> auto& { return s.scene.fog.start; })},
        {"Fog.end", field([](auto& s) -> auto& { return s.scene.fog.end; })},
        {"DepthOffset.offset", field([](auto& s) -> auto& { return s.scene.depth_offset; })},
    };
}

/// A member of one light. Setting it makes the light, and those before it, where there are fewer.
template <class Light, class Access>
Field light_field(std::vector<Light> oracle::Scene::*lights, std::size_t index, Access access) {
    return {[=](const Sample& sample) { return numbers(access((sample.scene.*lights)[index])); },
            [=](Sample& sample, const std::vector<double>& values) {
                std::vector<Light>& all = sample.scene.*lights;
                if (all.size() <= index) all.resize(index + 1);
                assign(access(all[index]), values);
            }};
}

/// An element of what is handed on for each light: "lightRays[2]". Setting it makes those before it too; one
/// that was never set is zero, as where the vertex stage is about to hand it on.
template <class Element>
std::optional<Field> handed_on_field(const std::string& name, std::string_view array,
                                     std::vector<Element> oracle::SurfacePoint::*elements) {
    const auto element = element_name(name, array);
    if (!element) return std::nullopt;
    const std::size_t index = element->index;
    return Field{[=](const Sample& sample) {
                     const std::vector<Element>& all = sample.surface.*elements;
                     return numbers(index < all.size() ? all[index] : Element(0));
                 },
                 [=](Sample& sample, const std::vector<double>& values) {
                     std::vector<Element>& all = sample.surface.*elements;
                     if (all.size() <= index) all.resize(index + 1);
                     assign(all[index], values);
                 }};
}

std::optional<Field> directional_field(const ElementName& name) {
    const auto of = [&](auto access) { return light_field(&oracle::Scene::directional, name.index, access); };
    if (name.member == "direction") return of([](auto& light) -> auto& { return light.direction; });
    if (name.member == "color") return of([](auto& light) -> auto& { return light.color; });
    return std::nullopt;
}

template <class Light>
std::optional<Field> point_field(std::vector<Light> oracle::Scene::*lights, const ElementName& name) {
    const auto of = [&](auto access) { return light_field(lights, name.index, access); };
    if (name.member == "color") return of([](auto& light) -> auto& { return light.color; });
    if (name.member == "attenuation") return of([](auto& light) -> auto& { return light.attenuation; });
    if (name.member != "position") return std::nullopt;
    Field position = of([](auto& light) -> auto& { return light.position; });
    position.get = [get = position.get](const Sample& sample) {  // a point as the shaders take it: its w is 1
        std::vector<double> values = get(sample);
        values.push_back(1);
        return values;
    };
    return position;
}

std::optional<Field> spot_field(const ElementName& name) {
    const auto of = [&](auto access) { return light_field(&oracle::Scene::spot, name.index, access); };
    if (name.member == "axis") return of([](auto& light) -> auto& { return light.axis; });
    if (name.member == "exponent") return of([](auto& light) -> auto& { return light.exponent; });
    if (name.member == "innerOneMinusCosine")
        return of([](auto& light) -> auto& { return light.inner_one_minus_cosine; });
    if (name.member == "outerOneMinusCosine")
        return of([](auto& light) -> auto& { return light.outer_one_minus_cosine; });
    return point_field(&oracle::Scene::spot, name);
}

FieldOfFamily family_field = nullptr;

std::optional<Field> lit_field_of(const std::string& name) {
    static const Fields plain = plain_fields();
    if (const auto found = plain.find(name); found != plain.end()) return found->second;
    if (auto ray = handed_on_field(name, "lightRays", &oracle::SurfacePoint::rays)) return ray;
    if (auto half = handed_on_field(name, "lightsHalfways", &oracle::SurfacePoint::halfways)) return half;
    if (auto cosines = cosines_field(name)) return cosines;
    if (const auto light = element_name(name, "DirectionalLights.lights")) return directional_field(*light);
    if (const auto light = element_name(name, "PointLights.lights"))
        return point_field(&oracle::Scene::point, *light);
    if (const auto light = element_name(name, "SpotLights.lights")) return spot_field(*light);
    if (auto surface = surface_field_of(name)) return surface;
    if (const auto image = image_light_field(name)) return image;
    return shadow_field(name);
}

Result<bool> feed_port(const evaluate::Port& port, std::span<const Sample> samples,
                       evaluate::Invocations& invocations) {
    const std::optional<Field> field = field_of(port.name);
    if (!field && port.name.starts_with("gl_")) return true;  // gl_InstanceID and the like: 0
    if (!field) {
        return fail(Fault::input, fmt::format("nothing is known to give '{}'", port.name),
                    "the oracle's samples must learn what it means (tools/verify/feed.cpp)");
    }
    std::vector<double>& values = invocations.values[port.name];
    values.resize(port.components * samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::vector<double> value = field->get(samples[i]);
        for (std::size_t c = 0; c < std::min<std::size_t>(port.components, value.size()); ++c)
            values[c * samples.size() + i] = value[c];
    }
    return true;
}

}  // namespace

void lay_fields_over_lit(FieldOfFamily field) {
    family_field = field;
}

std::optional<Field> field_of(const std::string& name) {
    std::optional<Field> field = lit_field_of(name);
    return family_field == nullptr ? field : family_field(name, std::move(field));
}

Result<evaluate::Invocations> feed(const evaluate::Program& program, std::span<const Sample> samples) {
    evaluate::Invocations invocations;
    invocations.count = samples.size();
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            if (const Result<bool> fed = feed_port(port, samples, invocations); !fed)
                return tl::unexpected(fed.error());
    feed_textures(program, samples, invocations);
    return invocations;
}

std::optional<Sample> sample_of(const evaluate::Program& program, const evaluate::Invocations& invocations) {
    Sample sample;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            const std::optional<Field> field = field_of(port.name);
            if (!field && !port.name.starts_with("gl_")) return std::nullopt;
            const auto given = invocations.values.find(port.name);
            if (!field) continue;
            field->set(sample, given == invocations.values.end() ? std::vector<double>(port.components)
                                                                 : given->second);
        }
    if (!read_textures(program, invocations, sample)) return std::nullopt;
    return sample;
}

}  // namespace gobo::verify
