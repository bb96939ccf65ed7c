#include "evaluate/texel_images.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::evaluate {
namespace {

using What = ImageRequest::What;
using Color = std::array<double, 4>;
using Direction = std::array<double, 3>;

/// Where a coordinate in texels lies between the centres of two of them.
struct Between {
    explicit Between(double at) : first(std::floor(at - 0.5)), share(at - 0.5 - first) {}
    double first;
    double share;  ///< of the next
};

/// The four texels around, weighted. `texel` gives the colour of column and row.
template <class Texel>
Color filtered(double u, double v, Texel texel) {
    const Between across(u);
    const Between up(v);
    Color sum{};
    for (int i = 0; i < 4; ++i) {
        const int right = i % 2;
        const int upper = i / 2;
        const double weight =
            (right == 1 ? across.share : 1 - across.share) * (upper == 1 ? up.share : 1 - up.share);
        const Color color = texel(across.first + right, up.first + upper);
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * color[c];
    }
    return sum;
}

std::size_t repeated(double at, int count) {
    return static_cast<std::size_t>(at - count * std::floor(at / count));
}

/// A face of the cube with coordinates from -1 to 1 across it.
struct OnFace {
    int face = 0;
    double s = 0;
    double t = 0;
};

/// OpenGL 4.5, table 8.19.
OnFace on_face(const Direction& r) {
    const double x = std::abs(r[0]);
    const double y = std::abs(r[1]);
    const double z = std::abs(r[2]);
    if (x >= y && x >= z) return {r[0] > 0 ? 0 : 1, (r[0] > 0 ? -r[2] : r[2]) / x, -r[1] / x};
    if (y >= z) return {r[1] > 0 ? 2 : 3, r[0] / y, (r[1] > 0 ? r[2] : -r[2]) / y};
    return {r[2] > 0 ? 4 : 5, (r[2] > 0 ? r[0] : -r[0]) / z, -r[1] / z};
}

/// The inverse, for points beyond the face's borders too.
Direction direction_of(const OnFace& at) {
    switch (at.face) {
        case 0:
            return {1, -at.t, -at.s};
        case 1:
            return {-1, -at.t, at.s};
        case 2:
            return {at.s, 1, at.t};
        case 3:
            return {at.s, -1, -at.t};
        case 4:
            return {at.s, -at.t, 1};
        default:
            return {-at.s, -at.t, -1};
    }
}

Color texel_of(const CubeTexels& texels, const OnFace& at) {
    const auto index = [&](double coordinate) {
        const double texel = std::floor((coordinate + 1) / 2 * texels.side);
        return static_cast<std::size_t>(std::clamp(texel, 0.0, texels.side - 1.0));
    };
    const auto side = static_cast<std::size_t>(texels.side);
    const auto channels = static_cast<std::size_t>(texels.channels);
    const std::size_t row = static_cast<std::size_t>(at.face) * side + index(at.t);
    const float* const first = &texels.values[(row * side + index(at.s)) * channels];
    return {first[0], first[1], first[2], channels > 3 ? static_cast<double>(first[3]) : 1.0};
}

}  // namespace

std::array<double, 4> answer(const ColorTexels& texels, const ImageRequest& request) {
    if (request.what == What::size)
        return {static_cast<double>(texels.width), static_cast<double>(texels.height), 1, 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    const auto texel = [&](double column, double row) -> Color {
        const std::size_t place = repeated(row, texels.height) * static_cast<std::size_t>(texels.width) +
                                  repeated(column, texels.width);
        const float* const first = &texels.values[4 * place];
        return {first[0], first[1], first[2], first[3]};
    };
    if (request.what == What::fetch) return texel(request.coordinates[0], request.coordinates[1]);
    return filtered(request.coordinates[0] * texels.width, request.coordinates[1] * texels.height, texel);
}

std::array<double, 4> answer(const CubeTexels& texels, const ImageRequest& request) {
    const auto side = static_cast<double>(texels.side);
    if (request.what == What::size) return {side, side, 1, 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    const OnFace middle = on_face({request.coordinates[0], request.coordinates[1], request.coordinates[2]});
    return filtered((middle.s + 1) / 2 * side, (middle.t + 1) / 2 * side, [&](double column, double row) {
        // The centre of a texel beyond a border is a texel's centre of the neighbouring face as well, to less
        // than half a texel along the border.
        const OnFace centre{middle.face, 2 * (column + 0.5) / side - 1, 2 * (row + 0.5) / side - 1};
        return texel_of(texels, on_face(direction_of(centre)));
    });
}

}  // namespace gobo::evaluate
