#include "lab/verify/shadow_map_check.hpp"

#include <algorithm>
#include <cmath>

#include "lab/raster/compare_picture.hpp"
#include "lab/raster/raster_object.hpp"

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
Slope slope_of(const raster::RasterObject& object, std::uint32_t triangle, const DepthPass& pass) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4& corner = object.positions[object.indices[3 * std::size_t{triangle} + i]];
        largest = std::max(largest, std::abs((corner.z / corner.w + 1) / 2));
    }
    const double slope = object.interpolator(triangle).depth_slope(0, 0);
    int exponent = 0;
    (void)std::frexp(largest, &exponent);  // of a number in [1/2, 1): one more than that of a float
    return {slope, pass.slope * slope + pass.units * std::ldexp(1, exponent - 1 - 23)};
}

/// The depths of one map, texel by texel.
class DepthLayers {
  public:
    explicit DepthLayers(int side)
        : side_(side), at_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

    void add(const raster::RasterObject& object, const DepthPass& pass) {
        for (const raster::Fragment& fragment : object.fragments) {
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

Result<DepthLayers> evaluated(const raster::Pipeline& pipeline, const DepthPass& pass,
                              const ShadowCamera& camera, const std::vector<Object>& objects) {
    ViewedObject viewed;
    viewed.view = camera.view;
    viewed.projection = camera.projection;
    viewed.viewport = {pass.side, pass.side};
    DepthLayers layers(pass.side);
    for (const Object& object : objects) {
        GOBO_TRY(const auto rasterised,
                 raster::rasterise_object(pipeline, pass.interface, object, pass.values, viewed));
        layers.add(rasterised, pass);
    }
    return layers;
}

Result<void> compare(const std::vector<Image>& drawn, const ShadowPass& pass,
                     const std::vector<ShadowCamera>& cameras, const std::vector<Object>& objects,
                     ShadowMapReport& report) {
    GOBO_TRY(const auto pipeline, raster::pipeline_of(pass.vertex, pass.fragment));
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        GOBO_TRY(const DepthLayers layers, evaluated(pipeline, pass.pass, cameras[i], objects));
        const Image& map = drawn[i];
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x)
                layers.judge(x, y, static_cast<double>(map.at(x, y, 0)), report);
        ++report.maps;
    }
    return {};
}

}  // namespace

vulkan::ShadowPass ShadowPass::for_vulkan() const {
    return {{{StageKind::vertex, vertex, {}}, {StageKind::fragment, fragment, {}}},
            pass.interface,
            pass.values,
            pass.side,
            pass.slope,
            pass.units};
}

bool ShadowMapReport::fails() const {
    return wrong > 0 ||
           static_cast<double>(edges) > raster::kLargestEdgePixelShare * static_cast<double>(texels);
}

ShadowMapReport compare_shadow_maps(const std::vector<Image>& drawn, const ShadowPass& pass,
                                    const std::vector<ShadowCamera>& cameras,
                                    const std::vector<Object>& objects) {
    ShadowMapReport report;
    if (const auto done = compare(drawn, pass, cameras, objects, report); !done)
        report.diagnostics = done.error();
    return report;
}

}  // namespace gobo::verify
