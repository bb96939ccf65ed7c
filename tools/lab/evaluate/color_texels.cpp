#include "lab/evaluate/color_texels.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::evaluate {
namespace {

using What = ImageRequest::What;
using Color = std::array<double, 4>;

/// A sum of texels, each by its weight.
class Blend {
  public:
    void add(const std::array<float, 4>& color, double weight) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const auto value = static_cast<double>(color[channel]);
            sum_[channel] += weight * value;
            plain_[channel] += value;
        }
        ++count_;
    }
    /// A texel that does not exist: the mean of those that do stands for it.
    void add_missing(double weight) { missing_ = weight; }

    [[nodiscard]] Color color() const {
        Color color = sum_;
        for (std::size_t channel = 0; channel < 4; ++channel)
            color[channel] += missing_ * plain_[channel] / count_;
        return color;
    }

  private:
    Color sum_{};
    Color plain_{};
    int count_ = 0;
    double missing_ = 0;
};

/// The texels on either side of a place along one axis.
struct Around {
    explicit Around(double place) : low(std::floor(place - 0.5)), share(place - 0.5 - low) {}
    double low;
    double share;  ///< of the upper one
};

/// Calls `add(column, row, weight)` for the four texels around a place in texels.
template <class Add>
void for_each_around(double x, double y, const Add& add) {
    const Around across(x);
    const Around up(y);
    add(across.low, up.low, (1 - across.share) * (1 - up.share));
    add(across.low + 1, up.low, across.share * (1 - up.share));
    add(across.low, up.low + 1, (1 - across.share) * up.share);
    add(across.low + 1, up.low + 1, across.share * up.share);
}

std::size_t repeated(double index, int count) {
    return static_cast<std::size_t>(index - std::floor(index / count) * count);
}

/// A face: the axis on which it lies, and the axes along which s and t grow (OpenGL 4.5, table 8.19).
struct Face {
    std::array<double, 3> axis, s, t;
};
constexpr std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                         {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Where a direction meets the cube: the face, and the place on it in texels.
struct OnCube {
    std::size_t face = 0;
    double x = 0;
    double y = 0;
};

OnCube on_cube(const std::array<double, 3>& direction, int side) {
    OnCube place;
    for (std::size_t face = 1; face < kFaces.size(); ++face)
        if (dot(direction, kFaces[face].axis) > dot(direction, kFaces[place.face].axis)) place.face = face;
    const Face& face = kFaces[place.face];
    const double ahead = dot(direction, face.axis);
    place.x = 0.5 * (dot(direction, face.s) / ahead + 1) * side;
    place.y = 0.5 * (dot(direction, face.t) / ahead + 1) * side;
    return place;
}

std::size_t cube_index(const OnCube& place, int side) {
    const auto at = [&](double coordinate) {
        return static_cast<std::size_t>(std::clamp(std::floor(coordinate), 0.0, side - 1.0));
    };
    const auto width = static_cast<std::size_t>(side);
    return (place.face * width + at(place.y)) * width + at(place.x);
}

/// The texel beyond the edge of a face: its centre, in the face's plane, seen from the middle of the cube
/// lies in the texel of the next face that touches it.
std::size_t across_edge(std::size_t face, double column, double row, int side) {
    const double s = 2 * (column + 0.5) / side - 1;
    const double t = 2 * (row + 0.5) / side - 1;
    std::array<double, 3> direction{};
    for (std::size_t i = 0; i < 3; ++i)
        direction[i] = kFaces[face].axis[i] + s * kFaces[face].s[i] + t * kFaces[face].t[i];
    return cube_index(on_cube(direction, side), side);
}

}  // namespace

Color answer(const ColorTexels& texels, const ImageRequest& request) {
    const auto at = [&](double x, double y) {
        return texels.colors[repeated(y, texels.height) * static_cast<std::size_t>(texels.width) +
                             repeated(x, texels.width)];
    };
    const auto& place = request.coordinates;
    if (request.what == What::size)
        return {static_cast<double>(texels.width), static_cast<double>(texels.height), 1, 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    Blend blend;
    if (request.what == What::fetch)
        blend.add(at(place[0], place[1]), 1);
    else
        for_each_around(place[0] * texels.width + request.offset[0],
                        place[1] * texels.height + request.offset[1],
                        [&](double x, double y, double weight) { blend.add(at(x, y), weight); });
    return blend.color();
}

Color answer(const CubeTexels& texels, const ImageRequest& request) {
    const auto side = static_cast<double>(texels.side);
    if (request.what == What::size) return {side, side, 1, 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    const auto& to = request.coordinates;
    const OnCube place = on_cube({to[0], to[1], to[2]}, texels.side);
    Blend blend;
    for_each_around(place.x, place.y, [&](double x, double y, double weight) {
        const bool is_across = x < 0 || x >= side;
        const bool is_above = y < 0 || y >= side;
        if (is_across && is_above) return blend.add_missing(weight);  // in a corner three faces meet
        const std::size_t index = is_across || is_above ? across_edge(place.face, x, y, texels.side)
                                                        : cube_index({place.face, x, y}, texels.side);
        blend.add(texels.colors[index], weight);
    });
    return blend.color();
}

}  // namespace gobo::evaluate
