#include "lab/verify/feed_surface.hpp"

#include <charconv>

#include "lab/verify/field_access.hpp"

namespace gobo::verify {
namespace {

Fields plain_fields() {
    return {
        {"color", field([](auto& s) -> auto& { return s.surface.color; })},
        {"vertexColor", field([](auto& s) -> auto& { return s.surface.color; })},
        {"texcoord", field([](auto& s) -> auto& { return s.texture_coordinate; })},
        {"textureCoordinate", field([](auto& s) -> auto& { return s.texture_coordinate; })},
        {"materialIndex", field([](auto& s) -> auto& { return s.surface.material; })},
        {"flatMaterialIndex", field([](auto& s) -> auto& { return s.surface.material; })},
        {"handedness", field([](auto& s) -> auto& { return s.handedness; })},
        {"gl_FrontFacing", field([](auto& s) -> auto& { return s.is_front_facing; })},
        {"backRadiance", field([](auto& s) -> auto& { return s.back_radiance; })},
        {"flatBackRadiance", field([](auto& s) -> auto& { return s.back_radiance; })},
        {"Hemisphere.up", field([](auto& s) -> auto& { return s.scene.hemisphere.up; })},
        {"Hemisphere.sky", field([](auto& s) -> auto& { return s.scene.hemisphere.sky; })},
        {"Hemisphere.ground", field([](auto& s) -> auto& { return s.scene.hemisphere.ground; })},
        {"Harmonics.toProbe", field([](auto& s) -> auto& { return s.scene.harmonics.to_probe; })},
        {"Harmonics.scale", field([](auto& s) -> auto& { return s.scene.harmonics.scale; })},
        {"Cutout.threshold", field([](auto& s) -> auto& { return s.scene.cutout_threshold; })},
    };
}

/// The three numbers of an array as a vector's.
template <class Access>
Field triple(Access access) {
    return {[access](const Sample& sample) {
                const auto& three = access(sample);
                return std::vector<double>(three.begin(), three.end());
            },
            [access](Sample& sample, const std::vector<double>& values) {
                std::copy_n(values.begin(), 3, access(sample).begin());
            }};
}

template <class Access>
std::optional<Field> material_member(std::string_view member, Access material) {
    const auto of = [&](auto access) { return field([=](auto& s) -> auto& { return access(material(s)); }); };
    if (member == "emission") return of([](auto& m) -> auto& { return m.emission; });
    if (member == "ambient") return of([](auto& m) -> auto& { return m.ambient; });
    if (member == "diffuse") return of([](auto& m) -> auto& { return m.diffuse; });
    if (member == "specular") return of([](auto& m) -> auto& { return m.specular; });
    if (member == "shininess") return of([](auto& m) -> auto& { return m.shininess; });
    if (member == "strength") return of([](auto& m) -> auto& { return m.strength; });
    return std::nullopt;
}

/// An element of a list that grows as it is set.
template <class Element>
Field growing(std::vector<Element> oracle::Scene::*list, std::size_t index) {
    return {[=](const Sample& sample) { return numbers((sample.scene.*list)[index]); },
            [=](Sample& sample, const std::vector<double>& values) {
                std::vector<Element>& all = sample.scene.*list;
                if (all.size() <= index) all.resize(index + 1);
                assign(all[index], values);
            }};
}

std::optional<Field> directional_or_point_member(const ElementName& name) {
    const auto of = [&](auto access) {
        return Field{
            [=](const Sample& s) { return numbers(access(s.scene.directional_or_point[name.index])); },
            [=](Sample& s, const std::vector<double>& values) {
                auto& all = s.scene.directional_or_point;
                if (all.size() <= name.index) all.resize(name.index + 1);
                assign(access(all[name.index]), values);
            }};
    };
    if (name.member == "position") return of([](auto& light) -> auto& { return light.position; });
    if (name.member == "color") return of([](auto& light) -> auto& { return light.color; });
    if (name.member == "attenuation") return of([](auto& light) -> auto& { return light.attenuation; });
    return std::nullopt;
}

/// A member of a row of the table.
std::optional<Field> row_member(const ElementName& row) {
    return material_member(
        row.member, [i = row.index](auto& s) -> auto& { return s.scene.materials[i]; });
}

}  // namespace

std::optional<ElementName> element_name(std::string_view name, std::string_view array) {
    if (!name.starts_with(array) || name.substr(array.size(), 1) != "[") return std::nullopt;
    name.remove_prefix(array.size() + 1);
    ElementName result;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), result.index);
    name.remove_prefix(static_cast<std::size_t>(end - name.data()));
    if (error != std::errc() || !name.starts_with("]")) return std::nullopt;
    result.member = name.substr(name.starts_with("].") ? 2 : 1);
    return result;
}

std::optional<Field> surface_field_of(const std::string& name) {
    static const Fields plain = plain_fields();
    if (const auto found = plain.find(name); found != plain.end()) return found->second;
    if (name == "ToonThresholds.thresholds")
        return triple([](auto& s) -> auto& { return s.scene.toon_thresholds; });
    if (name == "ToonThresholds.tones") return triple([](auto& s) -> auto& { return s.scene.toon_tones; });
    if (const auto light = element_name(name, "DirectionalOrPointLights.lights"))
        return directional_or_point_member(*light);
    if (const auto light = element_name(name, "LightAmbients.colors"))
        return growing(&oracle::Scene::light_ambients, light->index);
    if (const auto row = element_name(name, "Materials.rows"); row && row->index < 14)
        return row_member(*row);
    if (const auto term = element_name(name, "Harmonics.coefficients"); term && term->index < 9)
        return field([i = term->index](auto& s) -> auto& { return s.scene.harmonics.coefficients[i]; });
    return std::nullopt;
}

}  // namespace gobo::verify
