#include "lab/verify/shadow_witness.hpp"

#include <algorithm>
#include <cmath>

#include "lab/verify/compare_picture.hpp"
#include "lab/verify/software_picture.hpp"

namespace gobo::verify {
namespace {

/// A fragment's depth as it may be stored.
struct Depth {
    double value = 1;
    double error = 0;
    bool is_certain = false;  ///< covered, and not near an edge
    bool is_covered = false;
};

/// How a triangle's depth changes from texel to texel, and how far polygon offset moves it:
/// OpenGL 4.5, 14.6.5, of a depth buffer of floats.
struct Slope {
    double per_texel = 0;
    double offset = 0;
};
Slope slope_of(const SoftwareObject& object, std::uint32_t triangle, const DepthPass& pass) {
    std::array<glm::dvec4, 3> corners;
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = object.positions[object.indices[3 * std::size_t{triangle} + i]];
        largest = std::max(largest, std::abs((corners[i].z / corners[i].w + 1) / 2));
    }
    const Interpolator interpolator(corners, object.width, object.height);
    const double here = interpolator.at(0, 0).depth;
    const double slope =
        std::max(std::abs(interpolator.at(1, 0).depth - here), std::abs(interpolator.at(0, 1).depth - here));
    int exponent = 0;
    (void)std::frexp(largest, &exponent);  // of a number in [1/2, 1): one more than that of a float
    return {slope, pass.slope * slope + pass.units * std::ldexp(1, exponent - 1 - 23)};
}

/// The depths of one map, texel by texel.
class DepthLayers {
  public:
    explicit DepthLayers(int side)
        : side_(side), at_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

    void add(const SoftwareObject& object, const DepthPass& pass) {
        for (const Fragment& fragment : object.fragments) {
            const Slope slope = slope_of(object, fragment.triangle, pass);
            at_[index(fragment.x, fragment.y)].push_back(
                {std::clamp(fragment.weights.depth + slope.offset, 0.0, 1.0),
                 kMapDepthError + kMapPlaceError * slope.per_texel,
                 fragment.is_covered && !fragment.is_near_edge, fragment.is_covered});
        }
    }

    /// Judges a texel that holds `drawn`.
    void judge(int x, int y, double drawn, ShadowMapReport& report) const {
        const std::vector<Depth>& depths = at_[index(x, y)];
        Depth nearest;
        double certain = 1;
        for (const Depth& depth : depths) {
            if (depth.is_covered && depth.value < nearest.value) nearest = depth;
            if (depth.is_certain) certain = std::min(certain, depth.value + depth.error);
        }
        ++report.texels;
        const double ratio = std::abs(drawn - nearest.value) / std::max(nearest.error, kMapDepthError);
        if (ratio <= 1) {
            report.largest_ratio = std::max(report.largest_ratio, ratio);
            return;
        }
        const bool is_possible = std::any_of(depths.begin(), depths.end(), [&](const Depth& depth) {
            return depth.value <= certain && std::abs(drawn - depth.value) <= depth.error;
        });
        if (is_possible || (drawn == 1 && certain == 1))
            ++report.edges;
        else
            ++report.wrong;
    }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
    }
    int side_;
    std::vector<std::vector<Depth>> at_;
};

Result<DepthLayers> evaluated(const SoftwareProgram& program, const DepthPass& pass,
                              const ShadowCamera& camera, const std::vector<Object>& objects) {
    ViewedObject viewed;
    viewed.view = camera.view;
    viewed.projection = camera.projection;
    viewed.viewport = {pass.side, pass.side};
    DepthLayers layers(pass.side);
    for (const Object& object : objects) {
        const auto rasterised = rasterise_object(program, pass.interface, object, pass.values, viewed);
        if (!rasterised) return tl::unexpected(rasterised.error());
        layers.add(*rasterised, pass);
    }
    return layers;
}

}  // namespace

bool ShadowMapReport::fails() const {
    return wrong > 0 || static_cast<double>(edges) > kLargestEdgePixelShare * static_cast<double>(texels);
}

ShadowMapReport compare_shadow_maps(const ShadowMaps& drawn, const ShadowPass& pass,
                                    const std::vector<ShadowCamera>& cameras,
                                    const std::vector<Object>& objects) {
    ShadowMapReport report;
    const Result<SoftwareProgram> program = software_program(pass.vertex, pass.fragment);
    if (!program) {
        report.diagnostics = program.error();
        return report;
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const auto layers = evaluated(*program, pass.pass, cameras[i], objects);
        if (!layers) {
            report.diagnostics = layers.error();
            return report;
        }
        const Image map = drawn.layer(static_cast<int>(i));
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x)
                layers->judge(x, y, static_cast<double>(map.at(x, y, 0)), report);
        ++report.maps;
    }
    return report;
}

}  // namespace gobo::verify
