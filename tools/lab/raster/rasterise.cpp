#include "lab/raster/rasterise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gobo::raster {
namespace {

using Point = glm::vec<2, std::int64_t>;  // in subpixels

using Polygon = std::vector<glm::dvec4>;

/// Clips at the plane where `distance` is 0, keeping what is above (Sutherland and Hodgman 1974).
template <class Distance>
Polygon clip(const Polygon& polygon, const Distance& distance) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec4& from = polygon[i];
        const glm::dvec4& to = polygon[(i + 1) % polygon.size()];
        const double before = distance(from);
        const double after = distance(to);
        if (before >= 0) kept.push_back(from);
        if ((before >= 0) != (after >= 0)) kept.push_back(from + (to - from) * (before / (before - after)));
    }
    return kept;
}

/// Half as wide and high as how many windows: what lies further out, as towards w = 0 all does, is cut off,
/// so that products of two lengths in subpixels fit into 64 bits.
constexpr double kGuardBand = 128;

/// To the depth range and the guard band.
Polygon clipped(const std::array<glm::dvec4, 3>& corners) {
    Polygon polygon(corners.begin(), corners.end());
    polygon = clip(polygon, [](const glm::dvec4& point) { return point.z + point.w; });
    polygon = clip(polygon, [](const glm::dvec4& point) { return point.w - point.z; });
    for (const glm::length_t axis : {0, 1})
        for (const double sign : {-1.0, 1.0})
            polygon = clip(
                polygon, [&](const glm::dvec4& point) { return kGuardBand * point.w + sign * point[axis]; });
    return polygon;
}

bool is_finite(const glm::dvec4& position) {
    return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z) &&
           std::isfinite(position.w);
}

Point snapped(const glm::dvec4& clip_position, int width, int height) {
    const double x = (clip_position.x / clip_position.w + 1) / 2 * width;
    const double y = (clip_position.y / clip_position.w + 1) / 2 * height;
    return {std::llround(x * kSubpixels), std::llround(y * kSubpixels)};
}

/// One side of a triangle whose corners run counter-clockwise.
class Edge {
  public:
    Edge(const Point& from, const Point& to) : from_(from), dx_(to.x - from.x), dy_(to.y - from.y) {
        length_ = std::hypot(static_cast<double>(dx_), static_cast<double>(dy_));
        is_top_or_left_ = dy_ < 0 || (dy_ == 0 && dx_ < 0);
    }
    /// Distance in subpixels, positive on the inner side.
    [[nodiscard]] double distance(const Point& point) const {
        return length_ > 0 ? static_cast<double>(side(point)) / length_ : 0;
    }
    [[nodiscard]] bool covers(const Point& point) const {
        const std::int64_t where = side(point);
        return where > 0 || (where == 0 && is_top_or_left_);
    }

  private:
    [[nodiscard]] std::int64_t side(const Point& point) const {
        return dx_ * (point.y - from_.y) - dy_ * (point.x - from_.x);
    }
    Point from_;
    std::int64_t dx_, dy_;
    double length_ = 0;
    bool is_top_or_left_ = false;
};

/// The range of pixels whose centres may lie between two coordinates, kept inside of the window.
std::pair<int, int> pixel_range(std::int64_t low, std::int64_t high, int extent) {
    const double first = std::floor(static_cast<double>(low) / kSubpixels - 1);
    const double last = std::ceil(static_cast<double>(high) / kSubpixels + 1);
    return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(extent))),
            static_cast<int>(std::clamp(last, 0.0, static_cast<double>(extent)))};
}

/// Coverage of one pixel by all parts of a clipped triangle.
struct Coverage {
    bool is_covered = false;
    bool is_near_edge = false;
};

/// Part of a triangle, after clipping.
struct Part {
    std::array<Edge, 3> edges;
    Point low, high;

    Part(const Point& a, const Point& b, const Point& c)
        : edges{Edge(a, b), Edge(b, c), Edge(c, a)},
          low(glm::min(a, glm::min(b, c))),
          high(glm::max(a, glm::max(b, c))) {}

    /// Nothing where the centre is clearly outside.
    [[nodiscard]] std::optional<Coverage> coverage(int x, int y) const {
        const Point centre{x * std::int64_t{256} + 128, y * std::int64_t{256} + 128};
        double nearest = kNearEdge;
        bool is_covered = true;
        for (const Edge& edge : edges) {
            nearest = std::min(nearest, edge.distance(centre));
            is_covered = is_covered && edge.covers(centre);
        }
        if (nearest < -kNearEdge) return std::nullopt;
        return Coverage{is_covered, nearest < kNearEdge};
    }
};

/// The parts of a clipped triangle, all counter-clockwise.
std::vector<Part> parts_of(const Polygon& polygon, int width, int height, bool& is_front_facing) {
    std::vector<Point> points;
    for (const glm::dvec4& corner : polygon) points.push_back(snapped(corner, width, height));
    std::vector<Part> parts;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Point one = points[i] - points[0];
        const Point other = points[i + 1] - points[0];
        const std::int64_t area = one.x * other.y - one.y * other.x;
        if (area == 0) continue;
        is_front_facing = area > 0;
        parts.push_back(area > 0 ? Part(points[0], points[i], points[i + 1])
                                 : Part(points[0], points[i + 1], points[i]));
    }
    return parts;
}

/// A pixel on the seam of two parts is covered by one of them.
std::optional<Coverage> coverage_of(const std::vector<Part>& parts, int x, int y) {
    std::optional<Coverage> result;
    for (const Part& part : parts) {
        const std::optional<Coverage> coverage = part.coverage(x, y);
        if (coverage && (!result || coverage->is_covered)) result = coverage;
    }
    return result;
}

void add_fragments(std::vector<Fragment>& fragments, std::uint32_t triangle,
                   const std::array<glm::dvec4, 3>& corners, int width, int height) {
    if (!std::ranges::all_of(corners, is_finite)) return;  // drivers drop such a triangle
    const Interpolator interpolator(corners, width, height);
    bool is_front_facing = false;
    const std::vector<Part> parts = parts_of(clipped(corners), width, height, is_front_facing);
    if (interpolator.is_degenerate() || parts.empty()) return;
    Point low = parts.front().low;
    Point high = parts.front().high;
    for (const Part& part : parts) {
        low = glm::min(low, part.low);
        high = glm::max(high, part.high);
    }
    const auto [left, right] = pixel_range(low.x, high.x, width);
    const auto [bottom, top] = pixel_range(low.y, high.y, height);
    for (int y = bottom; y < top; ++y)
        for (int x = left; x < right; ++x)
            if (const auto coverage = coverage_of(parts, x, y))
                fragments.push_back({x, y, triangle, triangle, coverage->is_covered, coverage->is_near_edge,
                                     is_front_facing, interpolator.at(x + 0.5, y + 0.5)});
}

}  // namespace

Interpolator::Interpolator(const std::array<glm::dvec4, 3>& corners, int width, int height)
    : corners_(corners) {
    glm::dmat3 columns;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4& corner = corners[static_cast<std::size_t>(i)];
        columns[i] = {(corner.x + corner.w) / 2 * width, (corner.y + corner.w) / 2 * height, corner.w};
    }
    if (glm::determinant(columns) == 0) return;
    is_degenerate_ = false;
    const glm::dmat3 inverse = glm::inverse(columns);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            inverse_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = inverse[column][row];
}

Weights Interpolator::at(double x, double y) const {
    Weights weights;
    std::array<double, 3> over_w{};
    for (std::size_t i = 0; i < 3; ++i) {
        over_w[i] = inverse_[i][0] * x + inverse_[i][1] * y + inverse_[i][2];
        weights.inverse_w += over_w[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        weights.perspective[i] = over_w[i] / weights.inverse_w;
        weights.linear[i] = over_w[i] * corners_[i].w;
        weights.depth += over_w[i] * corners_[i].z;
    }
    weights.depth = (weights.depth + 1) / 2;
    return weights;
}

double Interpolator::depth_slope(double x, double y) const {
    const double depth = at(x, y).depth;
    return std::max(std::abs(at(x + 1, y).depth - depth), std::abs(at(x, y + 1).depth - depth));
}

std::vector<Fragment> rasterise(std::span<const glm::dvec4> positions, std::span<const std::uint32_t> indices,
                                int width, int height) {
    std::vector<Fragment> fragments;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        add_fragments(fragments, static_cast<std::uint32_t>(i / 3),
                      {positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]}, width,
                      height);
    }
    return fragments;
}

}  // namespace gobo::raster
