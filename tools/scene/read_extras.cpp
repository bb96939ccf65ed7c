#include <limits>

#include <fmt/format.h>

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

}  // namespace

void Wishes::fill_from(const Wishes& outer) {
    if (!fog) fog = outer.fog;
    if (!toon_levels) toon_levels = outer.toon_levels;
    if (!specular) specular = outer.specular;
    if (!probe) probe = outer.probe;
    if (!shadow) shadow = outer.shadow;
}

std::optional<Value> gobo_extras(Document& document, const Value& object) {
    // Other programs' extras may be of any type; only our own is looked into.
    const auto extras = object.json->find("extras");
    if (extras == object.json->end() || !extras->is_object()) return std::nullopt;
    return document.object({&*extras, path_to(object, "extras")}, "gobo");
}

Wishes read_wishes(Document& document, const Value& extras) {
    Wishes wishes;
    if (extras.json->contains("fog")) wishes.fog = read_fog(document, extras);
    if (const auto levels = document.integer(extras, "toon")) {
        wishes.toon_levels = static_cast<int>(*levels);
        if (*levels < 0 || *levels > 64) {
            document.error(path_to(extras, "toon"),
                           fmt::format("is {}, but must be between 0 and 64 levels", *levels));
        }
    }
    wishes.specular = document.choice(extras, "specular", {"none", "phong", "blinn"});
    wishes.probe = document.boolean(extras, "probe");
    wishes.shadow = document.boolean(extras, "shadow");
    return wishes;
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
