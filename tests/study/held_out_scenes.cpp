#include "held_out_scenes.hpp"

#include "lab/raster/random.hpp"
#include "study_support.hpp"

namespace gobo::study {
namespace {

RenderValue value(const std::string& name, std::vector<double> numbers, const std::string& source = {}) {
    RenderValue made;
    made.name = name;
    made.source = source;
    made.numbers = std::move(numbers);
    return made;
}

std::vector<double> numbers_of(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

/// A point above the floor, around the object.
glm::dvec3 place(Random& random) {
    const glm::dvec3 direction = random.direction();
    return glm::dvec3(2.2, 1.2, 2.2) * direction + glm::dvec3(0, 1.6, 0);
}

/// Lights of every kind, moved and coloured anew, and another material.
std::vector<RenderValue> other_values(Random& random) {
    std::vector<RenderValue> values;
    for (int i = 0; i < 8; ++i) {
        const std::string directional = "DirectionalLights.lights[" + std::to_string(i) + "].";
        const std::string point = "PointLights.lights[" + std::to_string(i) + "].";
        const std::string spot = "SpotLights.lights[" + std::to_string(i) + "].";
        glm::dvec3 direction = random.direction();
        direction.y = std::abs(direction.y) + 0.2;
        values.push_back(
            value(directional + "direction", numbers_of(glm::normalize(direction)), "eye_direction"));
        values.push_back(value(directional + "color", numbers_of(random.components(0.05, 0.6))));
        values.push_back(value(point + "position", numbers_of(place(random)), "eye_point"));
        values.push_back(value(point + "color", numbers_of(random.components(0.1, 1.2))));
        const glm::dvec3 position = place(random) + glm::dvec3(0, 1, 0);
        values.push_back(value(spot + "position", numbers_of(position), "eye_point"));
        values.push_back(value(spot + "axis", numbers_of(glm::normalize(glm::dvec3(0, -0.4, 0) - position)),
                               "eye_direction"));
        values.push_back(value(spot + "color", numbers_of(random.components(0.2, 1.5))));
    }
    values.push_back(value("Material.diffuse", numbers_of(random.components(0.2, 0.8))));
    values.push_back(value("Material.specular", numbers_of(random.components(0.1, 0.5))));
    return values;
}

StudyScene scene(const std::string& name, const std::string& mesh, int detail, int floor_cells,
                 std::array<double, 3> camera, double shininess, std::uint64_t seed) {
    StudyScene made;
    made.name = name;
    made.mesh = mesh;
    made.detail = detail;
    made.floor_cells = floor_cells;
    made.camera = camera;
    Random random(seed);
    made.values = other_values(random);
    made.values.push_back(value("Material.shininess", {shininess}));
    return made;
}

}  // namespace

std::vector<DrawnScene> held_out_scenes(const Family& family) {
    std::vector<DrawnScene> scenes;
    for (const StudyScene& one : {scene("torus from above", "torus", 48, 64, {0.5, 4, 2}, 80, 1),
                                  scene("coarse torus", "torus", 9, 2, {-2, 1, 4}, 30, 2),
                                  scene("fine sphere", "sphere", 160, 128, {2, 0.6, 3.5}, 7, 3),
                                  scene("teapot from behind", "teapot", 0, 40, {-1, 2, -5}, 200, 4),
                                  scene("upright light", "sphere", 32, 8, {0, 0.2, 6}, 1.5, 5)})
        scenes.push_back(draw_scene(source_files(), family, one).value());
    return scenes;
}

}  // namespace gobo::study
