#include "uber_ports.hpp"

#include <array>
#include <map>

#include <fmt/format.h>

namespace gobo::uber {
namespace {

using oracle::Model;

template <class Choice>
int number(Choice value) {
    return static_cast<int>(value);
}

/// What a switch is set to: the value's number among those of `lit`, which is that of the oracle's
/// enumerator.
const std::map<std::string, int (*)(const Model&), std::less<>>& switches() {
    static const std::map<std::string, int (*)(const Model&), std::less<>> table = {
        {"ambient", [](const Model& model) { return number(model.ambient); }},
        {"cutout", [](const Model& model) { return number(model.cutout); }},
        {"diffuse", [](const Model& model) { return number(model.diffuse); }},
        {"directional", [](const Model& model) { return model.directional; }},
        {"fog", [](const Model& model) { return number(model.fog); }},
        {"directional_or_point", [](const Model& model) { return model.directional_or_point; }},
        {"light_ambient", [](const Model& model) { return number(model.light_ambient); }},
        {"lighting", [](const Model& model) { return number(model.lighting); }},
        {"material", [](const Model& model) { return number(model.material); }},
        {"point", [](const Model& model) { return model.point; }},
        {"reflection", [](const Model& model) { return number(model.reflection); }},
        {"sides", [](const Model& model) { return number(model.sides); }},
        {"specular", [](const Model& model) { return number(model.specular); }},
        {"spot", [](const Model& model) { return model.spot; }},
        {"vertex_color", [](const Model& model) { return number(model.vertex_color); }},
    };
    return table;
}

/// A kind of light: its array in the looped lights, its block in `lit`.
struct Kind {
    const char* array;
    const char* block;
    int Model::*count;
    int Model::*shadows;  ///< null where none casts any
};

constexpr std::array kinds = {
    Kind{"directional", "DirectionalLights", &Model::directional, &Model::directional_shadows},
    Kind{"point", "PointLights", &Model::point, &Model::point_shadows},
    Kind{"spot", "SpotLights", &Model::spot, &Model::spot_shadows},
    Kind{"directional_or_point", "DirectionalOrPointLights", &Model::directional_or_point, nullptr}};

enum KindNumber : std::size_t { directional, point, spot, directional_or_point };

std::size_t count_of(const Model& model, std::size_t kind) {
    return static_cast<std::size_t>(model.*kinds[kind].count);
}

/// A light of the model: its kind, its number within it and among all.
struct Light {
    std::size_t kind;
    std::size_t of_kind;
    std::size_t of_all;
};

std::optional<Light> switched_light(const Model& model, std::size_t index) {
    std::size_t before = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        if (index < before + count_of(model, kind)) return Light{kind, index - before, index};
        before += count_of(model, kind);
    }
    return std::nullopt;
}

std::optional<Light> looped_light(const Model& model, std::size_t kind, std::size_t index) {
    std::size_t before = 0;
    for (std::size_t other = 0; other < kind; ++other) before += count_of(model, other);
    if (index >= count_of(model, kind)) return std::nullopt;
    return Light{kind, index, before + index};
}

/// The light's shadow in the order of the block `Shadows`: directional, spot, point lights.
std::optional<std::size_t> shadow_of(const Model& model, const Light& light) {
    const Kind& kind = kinds[light.kind];
    if (kind.shadows == nullptr || light.of_kind >= static_cast<std::size_t>(model.*kind.shadows))
        return std::nullopt;
    int before = 0;
    if (light.kind != directional) before += model.directional_shadows;
    if (light.kind == point) before += model.spot_shadows;
    return static_cast<std::size_t>(before) + light.of_kind;
}

UberPort flag(bool is_set) {
    return {"", is_set ? 1.0 : 0.0};
}

UberPort member_of(const Model& model, const std::optional<Light>& light, std::string_view member) {
    if (!light) return {};
    const auto shadow = shadow_of(model, *light);
    if (member == "isEnabled") return flag(true);
    if (member == "isLocal") return flag(light->kind == point || light->kind == spot);
    if (member == "isSpot") return flag(light->kind == spot);
    if (member == "isDirectionalOrPoint") return flag(light->kind == directional_or_point);
    if (member == "isShadowed") return flag(shadow.has_value());
    if (member == "ambient") {
        if (model.light_ambient == oracle::LightAmbient::none) return {};
        return {fmt::format("LightAmbients.colors[{}]", light->of_all), 0};
    }
    if (member.starts_with("shadow.")) {
        if (!shadow) return {};
        return {fmt::format("Shadows.shadows[{}].{}", *shadow, member.substr(7)), 0};
    }
    return {fmt::format("{}.lights[{}].{}", kinds[light->kind].block, light->of_kind, member), 0};
}

/// "axis" of "LoopedLights.spot[0].axis".
std::optional<verify::ElementName> element_name(std::string_view name, std::string_view array) {
    auto element = verify::element_name(name);
    if (!element || element->array != array) return std::nullopt;
    if (element->rest.starts_with(".")) element->rest.remove_prefix(1);
    return element;
}

std::optional<UberPort> light_port(const Model& model, std::string_view name) {
    if (const auto light = element_name(name, "SwitchedLights.lights"))
        return member_of(model, switched_light(model, light->index), light->rest);
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        if (const auto light = element_name(name, fmt::format("LoopedLights.{}", kinds[kind].array)))
            return member_of(model, looped_light(model, kind, light->index), light->rest);
    return std::nullopt;
}

}  // namespace

std::optional<UberPort> uber_port(const Model& model, std::string_view name) {
    constexpr std::string_view of_switches = "Switches.";
    if (name.starts_with(of_switches)) {
        const auto found = switches().find(name.substr(of_switches.size()));
        if (found == switches().end()) return std::nullopt;
        return UberPort{"", static_cast<double>(found->second(model))};
    }
    if (name == "Toon.thresholds" || name == "Toon.tones")
        return UberPort{fmt::format("ToonThresholds.{}", name.substr(name.find('.') + 1)), 0};
    const auto row = element_name(name, "Materials.rows");
    if (row && row->index == 0 && model.material == oracle::MaterialChoice::uniform)
        return UberPort{fmt::format("Material.{}", row->rest), 0};
    return light_port(model, name);
}

std::optional<verify::Field> uber_field(const std::string& name, std::optional<verify::Field> own) {
    const bool has_row = name.starts_with("Materials.");
    if (!has_row && !uber_port({}, name)) return own;
    const auto get = [name, own](const verify::Sample& sample) -> std::vector<double> {
        const auto port = uber_port(sample.model, name);
        if (!port) return own ? own->get(sample) : std::vector<double>{};
        if (port->lit_name.empty()) return {port->number};
        const auto field = verify::field_of(port->lit_name);
        return field ? field->get(sample) : std::vector<double>{};
    };
    return verify::Field{get, [](verify::Sample&, const std::vector<double>&) {}};
}

}  // namespace gobo::uber
