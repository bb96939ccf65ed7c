#include "lab/probe/cube_map.hpp"

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

namespace gobo::probe {
namespace {

/// The axis of a face, and those along which s and t grow.
struct Face {
    glm::dvec3 axis, s, t;
};

const std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                     {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                     {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                     {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                     {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                     {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

void fill_row(Image& image, int side, int row, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    for (int column = 0; column < side; ++column) {
        const glm::dvec3 value = radiance(cube_direction(row / side, side, column, row % side));
        for (int channel = 0; channel < 3; ++channel)
            image.at(column, row, channel) = static_cast<float>(value[channel]);
    }
}

}  // namespace

glm::dvec3 cube_direction(int face, int side, int column, int row) {
    const Face& on = kFaces[static_cast<std::size_t>(face)];
    const double s = 2 * (column + 0.5) / side - 1;
    const double t = 2 * (row + 0.5) / side - 1;
    return glm::normalize(on.axis + s * on.s + t * on.t);
}

Image make_cube_map(int side, int jobs, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    Image image(side, 6 * side, 3);
    std::atomic<int> next = 0;
    const auto work = [&] {
        for (int row = next++; row < 6 * side; row = next++) fill_row(image, side, row, radiance);
    };
    std::vector<std::jthread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back(work);
    work();
    return image;
}

}  // namespace gobo::probe
