#include "light_blocks.hpp"

#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>

#include "scene/effects.hpp"

namespace viewer {
namespace {

using gobo::scene::LightKind;
using gobo::scene::PlacedLight;

/// 1 - cos(angle), which holds small angles as well as large ones.
float one_minus_cosine(double angle) {
    const double sine = std::sin(angle / 2);
    return static_cast<float>(2 * sine * sine);
}

/// A light where its node stands, seen from the eye.
struct SeenLight {
    const gobo::scene::Light& light;
    glm::vec4 position;
    glm::vec3 shines_along;
};

/// Fills the members that the kind of light has.
template <class Light>
void fill(const SeenLight& seen, Light& to) {
    to.color = glm::vec3(seen.light.color);
    if constexpr (requires { to.direction; }) to.direction = -seen.shines_along;
    if constexpr (requires { to.position; }) {
        to.position = seen.position;
        to.position.w = static_cast<float>(1 / seen.light.range);  // `pbr` reads it, `lit` does not
        to.attenuation = glm::vec3(seen.light.attenuation);
    }
    if constexpr (requires { to.axis; }) {
        to.exponent = static_cast<float>(seen.light.exponent);
        to.innerOneMinusCosine = one_minus_cosine(seen.light.inner_angle);
        to.outerOneMinusCosine = one_minus_cosine(seen.light.outer_angle);
        to.axis = seen.shines_along;
    }
}

/// Fills the next free element, if there is one.
template <class Block>
void add(const SeenLight& seen, Block& block, std::size_t& count) {
    if (count < std::size(block.lights)) fill(seen, block.lights[count++]);
}

glm::vec3 unit_or_zero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 ? glm::vec3(vector / length) : glm::vec3(0);
}

}  // namespace

template <class Blocks>
Blocks light_blocks(const Stage& stage, const StageDraw& draw, const glm::dmat4& view) {
    const std::vector<PlacedLight> lights = gobo::scene::place_lights(stage.scene);
    Blocks blocks;
    std::size_t directional = 0;
    std::size_t point = 0;
    std::size_t spot = 0;
    for (const std::size_t number : draw.lights) {
        const PlacedLight& placed = lights[number];
        const glm::dmat4& world = stage.scene.nodes[placed.node].world;
        const SeenLight seen{*placed.light, glm::vec4(view * world[3]),
                             unit_or_zero(glm::dmat3(view) * placed.direction)};
        if (placed.light->kind == LightKind::directional) add(seen, blocks.directional, directional);
        if (placed.light->kind == LightKind::point) add(seen, blocks.point, point);
        if (placed.light->kind == LightKind::spot) add(seen, blocks.spot, spot);
    }
    return blocks;
}

template ClassicLights light_blocks(const Stage&, const StageDraw&, const glm::dmat4&);
template PhysicalLights light_blocks(const Stage&, const StageDraw&, const glm::dmat4&);

}  // namespace viewer
