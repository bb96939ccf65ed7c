#include "verify/switched_feed.hpp"

#include <array>
#include <map>

#include <fmt/format.h>

#include "verify/field_access.hpp"

namespace gobo::verify {
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
        {"homogeneous", [](const Model& model) { return model.homogeneous; }},
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
    Kind{"homogeneous", "HomogeneousLights", &Model::homogeneous, nullptr}};

enum KindNumber : std::size_t { directional, point, spot, homogeneous };

/// A light of the sample: its kind, its number within it and among all.
struct Light {
    std::size_t kind;
    std::size_t of_kind;
    std::size_t of_all;
};

std::optional<Light> switched_light(const Model& model, std::size_t index) {
    std::size_t before = 0;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        const auto count = static_cast<std::size_t>(model.*kinds[kind].count);
        if (index < before + count) return Light{kind, index - before, index};
        before += count;
    }
    return std::nullopt;
}

std::optional<Light> looped_light(const Model& model, std::size_t kind, std::size_t index) {
    std::size_t before = 0;
    for (std::size_t other = 0; other < kind; ++other)
        before += static_cast<std::size_t>(model.*kinds[other].count);
    if (index >= static_cast<std::size_t>(model.*kinds[kind].count)) return std::nullopt;
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

std::vector<double> numbers_of(const Sample& sample, const std::string& lit_name) {
    const std::optional<Field> field = field_of(lit_name);
    return field ? field->get(sample) : std::vector<double>{};
}

/// A member of a light; nothing (which is fed as zeros) where the light's kind does not have it.
std::vector<double> member_of(const Sample& sample, const Light& light, const std::string& member) {
    const auto shadow = shadow_of(sample.model, light);
    if (member == "isEnabled") return {1};
    if (member == "isLocal") return {light.kind == point || light.kind == spot ? 1.0 : 0.0};
    if (member == "isSpot") return {light.kind == spot ? 1.0 : 0.0};
    if (member == "isHomogeneous") return {light.kind == homogeneous ? 1.0 : 0.0};
    if (member == "isShadowed") return {shadow ? 1.0 : 0.0};
    if (member == "ambient") {
        if (sample.model.light_ambient == oracle::LightAmbient::none) return {};
        return numbers_of(sample, fmt::format("LightAmbients.colors[{}]", light.of_all));
    }
    if (member.starts_with("shadow.")) {
        if (!shadow) return {};
        return numbers_of(sample, fmt::format("Shadows.shadows[{}].{}", *shadow, member.substr(7)));
    }
    return numbers_of(sample,
                      fmt::format("{}.lights[{}].{}", kinds[light.kind].block, light.of_kind, member));
}

using FindLight = std::optional<Light> (*)(const Model&, std::size_t kind, std::size_t index);

Field light_field(FindLight find, std::size_t kind, const ElementName& name) {
    const std::size_t index = name.index;
    return {[=, member = std::string(name.member)](const Sample& sample) {
                const std::optional<Light> light = find(sample.model, kind, index);
                return light ? member_of(sample, *light, member) : std::vector<double>{};
            },
            [](Sample&, const std::vector<double>&) {}};
}

Field switch_field(int (*setting)(const Model&)) {
    return {[setting](const Sample& sample) { return numbers(setting(sample.model)); },
            [](Sample&, const std::vector<double>&) {}};
}

}  // namespace

std::optional<Field> switched_field(const std::string& name) {
    constexpr std::string_view prefix = "Switches.";
    if (name.starts_with(prefix)) {
        const auto found = switches().find(std::string_view(name).substr(prefix.size()));
        return found == switches().end() ? std::nullopt : std::optional(switch_field(found->second));
    }
    if (name == "Toon.thresholds" || name == "Toon.tones")
        return field_of("ToonThresholds." + name.substr(name.find('.') + 1));
    if (const auto light = element_name(name, "SwitchedLights.lights"))
        return light_field(
            [](const Model& model, std::size_t, std::size_t index) { return switched_light(model, index); },
            0, *light);
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        if (const auto light = element_name(name, fmt::format("LoopedLights.{}", kinds[kind].array)))
            return light_field(looped_light, kind, *light);
    return std::nullopt;
}

}  // namespace gobo::verify
