// Which pixels a triangle covers, and with what weights its corners reach each of them: as llvmpipe does it,
// in exact arithmetic.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace gobo::raster {

/// How much of each of a triangle's corners a point of the window gets.
struct Weights {
    std::array<double, 3> perspective{};  ///< of smooth varyings; they add up to 1
    std::array<double, 3> linear{};       ///< of noperspective ones, and of depth
    double depth = 0;                     ///< in the window, 0 to 1 inside the view volume
    double inverse_w = 0;                 ///< gl_FragCoord.w
};

/// A triangle's part in one pixel. Pixels are counted from the lower left.
struct Fragment {
    int x = 0;
    int y = 0;
    std::uint32_t triangle = 0;
    std::uint32_t primitive = 0;  ///< the triangle's number as it is drawn: gl_PrimitiveID
    bool is_covered = false;
    /// The pixel's centre lies so near to an edge that a vertex off by a rounding decides whether it is
    /// covered.
    bool is_near_edge = false;
    bool is_front_facing = false;
    Weights weights;
};

/// Positions are snapped to this fraction of a pixel before coverage is decided: llvmpipe's, and the least
/// that OpenGL's drivers commonly report as GL_SUBPIXEL_BITS = 8.
inline constexpr double kSubpixels = 256;

/// A centre within this distance of an edge, in subpixels, is near it: a rounding of a position moves its
/// snapped one by a whole subpixel.
inline constexpr double kNearEdge = 1.5;

/// The corners' weights at any point of the window, in pixels: inside of a triangle, outside of it, and where
/// it reaches behind the eye. `corners` are in clip space, not snapped. Zeros for a triangle seen edge on.
///
/// Source: Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997.
class Interpolator {
  public:
    Interpolator(const std::array<glm::dvec4, 3>& corners, int width, int height);
    [[nodiscard]] bool is_degenerate() const { return is_degenerate_; }
    [[nodiscard]] Weights at(double x, double y) const;
    /// The largest change of depth from one pixel to the next, to the right or upwards.
    [[nodiscard]] double depth_slope(double x, double y) const;

  private:
    std::array<glm::dvec4, 3> corners_;
    std::array<std::array<double, 3>, 3> inverse_{};  ///< row i gives corner i's weight over w
    bool is_degenerate_ = true;
};

/// The fragments of indexed triangles: those covered, and those that nearly are. Sorted by triangle, then
/// row, then column. Triangles are clipped at the near and the far plane, and covered by the top-left rule.
[[nodiscard]] std::vector<Fragment> rasterise(std::span<const glm::dvec4> positions,
                                              std::span<const std::uint32_t> indices, int width, int height);

}  // namespace gobo::raster
