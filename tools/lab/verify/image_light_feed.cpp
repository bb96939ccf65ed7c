#include "lab/verify/image_light_feed.hpp"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace gobo::verify {
namespace {

void fill(Random& random, oracle::ImageLight& light) {
    light.color = random.components(0, 1);
    light.weight = random.one_in(8) ? static_cast<double>(random.whole(0, 1)) : random.unit();
    light.to_map = glm::dmat3(glm::rotate(glm::dmat4(1), random.between(0, 6.28), random.direction()));
    light.map.mean = random.components(0.5, 2);
    for (int column = 0; column < 3; ++column) light.map.slope[column] = random.components(-0.25, 0.25);
}

template <class Numbers>
void round_all(Numbers& numbers) {
    double* first = glm::value_ptr(numbers);
    for (std::size_t i = 0; i < sizeof(Numbers) / sizeof(double); ++i)
        first[i] = static_cast<float>(first[i]);
}

void round_all(oracle::ImageLight& light) {
    round_all(light.color);
    light.weight = static_cast<float>(light.weight);
    round_all(light.to_map);
}

/// So many numbers from what `access` gives the address of.
template <class Access>
Field field(std::size_t components, Access access) {
    return {[=](const Sample& sample) {
                const double* first = access(sample.scene);
                return std::vector<double>(first, first + components);
            },
            [=](Sample& sample, const std::vector<double>& values) {
                std::copy_n(values.begin(), std::min(values.size(), components), access(sample.scene));
            }};
}

}  // namespace

void fill_image_lights(Random& random, oracle::Scene& scene) {
    fill(random, scene.image_light);
    fill(random, scene.reflection);
}

void round_image_lights(oracle::Scene& scene) {
    round_all(scene.image_light);
    round_all(scene.reflection);
}

std::optional<Field> image_light_field(std::string_view name) {
    if (name == "ImageLight.color")
        return field(3, [](auto& scene) { return glm::value_ptr(scene.image_light.color); });
    if (name == "ImageLight.weight") return field(1, [](auto& scene) { return &scene.image_light.weight; });
    if (name == "ImageLight.toMap")
        return field(9, [](auto& scene) { return glm::value_ptr(scene.image_light.to_map); });
    if (name == "Reflection.weight") return field(1, [](auto& scene) { return &scene.reflection.weight; });
    if (name == "Reflection.toMap")
        return field(9, [](auto& scene) { return glm::value_ptr(scene.reflection.to_map); });
    return std::nullopt;
}

}  // namespace gobo::verify
