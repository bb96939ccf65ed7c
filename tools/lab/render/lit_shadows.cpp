#include "lab/render/lit_shadows.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace gobo {
namespace {

int count_of(const Family& family, const Key& key, const char* feature) {
    const auto index = family.index_of(feature);
    return index ? key[static_cast<std::size_t>(*index)] : 0;
}

/// The numbers given to a member of a light; zeros where there are none.
std::vector<double> numbers_of(const Family& family, const std::string& name) {
    for (const RenderValue& value : family.render)
        if (value.name == name && value.numbers.size() >= 1) return value.numbers;
    return {};
}

glm::dvec3 vector_of(const Family& family, const std::string& name) {
    glm::dvec3 vector(0);
    const std::vector<double> numbers = numbers_of(family, name);
    for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 3); ++i)
        vector[static_cast<glm::length_t>(i)] = numbers[i];
    return vector;
}

glm::dvec3 direction_of(const Family& family, const std::string& name) {
    const glm::dvec3 vector = vector_of(family, name);
    const double length = glm::length(vector);
    return length > 0 ? vector / length : glm::dvec3(0, 1, 0);
}

}  // namespace

std::vector<ShadowLight> shadow_lights(const Family& family, const Key& key) {
    using Kind = ShadowLight::Kind;
    std::vector<ShadowLight> lights;
    for (int i = 0; i < count_of(family, key, "directional_shadows"); ++i) {
        const std::string light = fmt::format("DirectionalLights.lights[{}]", i);
        lights.push_back({Kind::directional, glm::dvec3(0), direction_of(family, light + ".direction"), 0});
    }
    for (int i = 0; i < count_of(family, key, "spot_shadows"); ++i) {
        const std::string light = fmt::format("SpotLights.lights[{}]", i);
        const std::vector<double> versine = numbers_of(family, light + ".outerVersine");
        const double cosine = 1 - (versine.empty() ? 1 : std::clamp(versine.front(), 0.0, 2.0));
        lights.push_back({Kind::spot, vector_of(family, light + ".position"),
                          direction_of(family, light + ".axis"), std::acos(cosine)});
    }
    for (int i = 0; i < count_of(family, key, "point_shadows"); ++i) {
        const std::string light = fmt::format("PointLights.lights[{}]", i);
        lights.push_back({Kind::point, vector_of(family, light + ".position"), glm::dvec3(0), 0});
    }
    return lights;
}

}  // namespace gobo
