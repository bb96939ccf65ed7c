#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

Fog read_fog(Document& document, const Value& extras) {
    Fog fog;
    const auto value = document.object(extras, "fog");
    if (!value) return fog;
    document.only(*value, {"color", "density", "far", "kind", "near"});
    fog.kind = document.choice(*value, "kind", {"none", "linear", "exponential", "exponential_squared"})
                   .value_or("");
    if (fog.kind.empty()) document.error(path_to(*value, "kind"), "is missing");
    fog.color = read_color(document, *value, "color").value_or(glm::dvec3(0));
    fog.near = document.number_within(*value, "near", 0, unbounded).value_or(0);
    fog.far = document.number_within(*value, "far", 0, unbounded).value_or(0);
    fog.density = document.number_within(*value, "density", 0, unbounded).value_or(0);
    if (fog.kind == "linear" && fog.far < fog.near) {
        document.error(path_to(*value, "far"),
                       fmt::format("is {:g}, nearer than near, {:g}", fog.far, fog.near));
    }
    return fog;
}

/// 1 / pi: then what the polynomial gives is the radiance of a white surface.
constexpr double lambertian = 1 / std::numbers::pi;

void read_coefficients(Document& document, const Value& value, Probe& probe) {
    const std::vector<Value> rows = document.elements(value, "coefficients");
    if (rows.size() != probe.coefficients.size()) {
        document.error(path_to(value, "coefficients"),
                       fmt::format("must hold 9 colours, not {}", rows.size()));
        return;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto color = document.numbers_of(rows[i], 3);
        if (!color) return;
        probe.coefficients[i] = {(*color)[0], (*color)[1], (*color)[2]};
    }
}

glm::dvec3 read_up(Document& document, const Value& value) {
    const auto numbers = document.numbers(value, "up", 3);
    if (!numbers) return {0, 1, 0};
    const glm::dvec3 up((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    const double length = glm::length(up);
    if (length > 1e-6 && length < 1e6) return up / length;
    document.error(path_to(value, "up"), "is no direction");
    return {0, 1, 0};
}

Probe read_probe(Document& document, const Value& extras) {
    Probe probe;
    const auto value = document.object(extras, "probe");
    if (!value) return probe;
    document.only(*value, {"coefficients", "ground", "kind", "scale", "share", "sky", "up"});
    probe.kind =
        document.choice(*value, "kind", {"none", "hemisphere", "spherical_harmonics", "image"}).value_or("");
    if (probe.kind.empty()) document.error(path_to(*value, "kind"), "is missing");
    probe.up = read_up(document, *value);
    probe.sky = read_color(document, *value, "sky").value_or(glm::dvec3(0));
    probe.ground = read_color(document, *value, "ground").value_or(glm::dvec3(0));
    probe.scale = document.number_within(*value, "scale", 0, 1e3).value_or(lambertian);
    probe.share = document.number_within(*value, "share", 0, 1).value_or(1);
    if (probe.kind == "spherical_harmonics") read_coefficients(document, *value, probe);
    return probe;
}

/// Which features there are is the family's to say, and the key's to find out.
std::map<std::string, std::string> read_quality(Document& document, const Value& extras) {
    std::map<std::string, std::string> quality;
    const auto value = document.object(extras, "quality");
    if (!value) return quality;
    for (const auto& [feature, chosen] : value->json->items()) {
        const auto text = document.string(*value, feature);
        if (!text) return {};
        quality[feature] = *text;
    }
    return quality;
}

}  // namespace

void Overrides::fill_from(const Overrides& outer) {
    if (!fog) fog = outer.fog;
    if (!toon_levels) toon_levels = outer.toon_levels;
    if (!specular) specular = outer.specular;
    if (!probe) probe = outer.probe;
    if (!reflection) reflection = outer.reflection;
    if (!shadow) shadow = outer.shadow;
    quality.insert(outer.quality.begin(), outer.quality.end());
}

std::optional<Value> gobo_extras(Document& document, const Value& object) {
    // Other programs' extras may be of any type; only our own is looked into.
    const auto extras = object.json->find("extras");
    if (extras == object.json->end() || !extras->is_object()) return std::nullopt;
    return document.object({&*extras, path_to(object, "extras")}, "gobo");
}

Overrides read_overrides(Document& document, const Value& extras, std::vector<std::string> others) {
    for (const char* name : {"fog", "probe", "quality", "reflection", "shadow", "specular", "toon"})
        others.emplace_back(name);
    document.only(extras, others);
    Overrides overrides;
    if (extras.json->contains("fog")) overrides.fog = read_fog(document, extras);
    if (const auto levels = document.integer(extras, "toon")) {
        overrides.toon_levels = static_cast<int>(*levels);
        if (*levels < 0 || *levels > 64) {
            document.error(path_to(extras, "toon"),
                           fmt::format("is {}, but must be between 0 and 64 levels", *levels));
        }
    }
    overrides.specular = document.choice(extras, "specular", {"none", "phong", "blinn"});
    if (extras.json->contains("probe")) overrides.probe = read_probe(document, extras);
    overrides.reflection = document.number_within(extras, "reflection", 0, 1);
    overrides.quality = read_quality(document, extras);
    overrides.shadow = document.boolean(extras, "shadow");
    return overrides;
}

std::optional<glm::dvec3> read_color(Document& document, const Value& parent, std::string_view name) {
    const auto numbers = document.numbers(parent, name, 3);
    if (!numbers) return std::nullopt;
    const glm::dvec3 color((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    if (color.r < 0 || color.g < 0 || color.b < 0)
        document.error(path_to(parent, name), "holds a negative number");
    return color;
}

}  // namespace gobo::scene
