// The first of the two passes of shadows, cross-checked: the depths that the renderer drew into its shadow
// maps, held against their evaluation.
#pragma once

#include <vector>

#include "lab/render/shadow_maps.hpp"
#include "lab/vulkan/picture.hpp"
#include "validate/validate.hpp"

namespace gobo::verify {

/// The depth pass as the renderer takes it, and as evaluation does.
struct ShadowPass {
    DepthPass pass;
    SpirvModule vertex;
    SpirvModule fragment;

    /// As Vulkan's renderer takes it; points at the modules.
    [[nodiscard]] vulkan::ShadowPass for_vulkan() const;
};

/// A texel may be off by this: llvmpipe interpolates depth in floats, a rounding of which is 6e-8 near 1.
inline constexpr double kMapDepthError = 2e-7;
/// And by how much the depth changes over this part of a texel: the corners of a triangle that is clipped are
/// known to 1/256, and polygon offset is twice the slope.
inline constexpr double kMapPlaceError = 1.5 / 256;

/// How a number of maps came out.
struct ShadowMapReport {
    std::size_t maps = 0;
    std::size_t texels = 0;
    std::size_t edges = 0;  ///< right, but covered differently at a triangle's edge
    std::size_t wrong = 0;
    double largest_ratio = 0;  ///< of an error to its limit
    Diagnostics diagnostics;   ///< why there is no evaluation

    /// Wrong texels, or more than 1 % at edges.
    [[nodiscard]] bool fails() const;
};
GOBO_FIELDS(ShadowMapReport, maps, texels, edges, wrong, largest_ratio, diagnostics)

/// The maps of `cameras`, in their order, drawn by `pass`; row 0 of each is that at t = 0.
[[nodiscard]] ShadowMapReport compare_shadow_maps(const std::vector<Image>& drawn, const ShadowPass& pass,
                                                  const std::vector<ShadowCamera>& cameras,
                                                  const std::vector<Object>& objects);

}  // namespace gobo::verify
