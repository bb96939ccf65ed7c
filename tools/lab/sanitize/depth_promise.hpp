// What a fragment stage promises of the depth that it writes (ARB_conservative_depth, GLSL 4.20).
#pragma once

#include <cstdint>
#include <span>

namespace gobo::sanitize {

/// The written depth against gl_FragCoord.z: `layout(depth_greater) out float gl_FragDepth` and its like.
enum class DepthPromise { none, greater, less, unchanged };

/// That of a SPIR-V module; `none` where it has none, or is none.
[[nodiscard]] DepthPromise depth_promise_of(std::span<const std::uint32_t> spirv);

}  // namespace gobo::sanitize
