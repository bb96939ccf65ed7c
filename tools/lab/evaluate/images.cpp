#include "lab/evaluate/images.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::evaluate {
namespace {

using What = ImageRequest::What;

std::array<double, 4> all_of(double value) {
    return {value, value, value, value};
}

double depth_at(const DepthTexels& texels, double x, double y, double layer) {
    const auto index = [](double at, int count) {
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
    };
    const std::size_t row =
        index(std::round(layer), texels.layers) * static_cast<std::size_t>(texels.height) +
        index(y, texels.height);
    return texels.depths[row * static_cast<std::size_t>(texels.width) + index(x, texels.width)];
}

double compared(const DepthTexels& texels, const ImageRequest& request, double x, double y) {
    return request.reference <= depth_at(texels, x, y, request.coordinates[2]) ? 1 : 0;
}

/// OpenGL 4.5, 8.14.3: the texels at floor(u - 1/2) and the next, weighted by what is left.
double filtered(const DepthTexels& texels, const ImageRequest& request) {
    const double u = request.coordinates[0] * texels.width - 0.5;
    const double v = request.coordinates[1] * texels.height - 0.5;
    const double left = std::floor(u);
    const double lower = std::floor(v);
    const double alpha = u - left;
    const double beta = v - lower;
    return (1 - alpha) * (1 - beta) * compared(texels, request, left, lower) +
           alpha * (1 - beta) * compared(texels, request, left + 1, lower) +
           (1 - alpha) * beta * compared(texels, request, left, lower + 1) +
           alpha * beta * compared(texels, request, left + 1, lower + 1);
}

}  // namespace

std::array<double, 4> answer(const std::array<double, 4>& color, const ImageRequest& request, double side) {
    if (request.what == What::size) return all_of(side);
    if (request.what == What::levels) return {std::log2(side) + 1, 0, 0, 0};
    if (request.compares) return all_of(request.reference <= color[0] ? 1 : 0);
    if (request.what == What::gather) return all_of(color[static_cast<std::size_t>(request.component)]);
    return color;
}

std::array<double, 4> answer(const DepthTexels& texels, const ImageRequest& request) {
    if (request.what == What::size)
        return {static_cast<double>(texels.width), static_cast<double>(texels.height),
                static_cast<double>(texels.layers), 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    if (request.compares) return all_of(filtered(texels, request));
    return all_of(depth_at(texels, request.coordinates[0], request.coordinates[1], request.coordinates[2]));
}

}  // namespace gobo::evaluate
