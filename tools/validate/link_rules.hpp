// What stages must agree about to make one program, and what a program may take of a device: the rules
// that glslang does not check, or checks without saying where.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "family/family.hpp"
#include "reflect/reflect.hpp"

namespace gobo {

/// A stage as the rules see it.
struct StageView {
    StageKind kind;
    const Interface& interface;
    std::vector<const Piece*> pieces;
};

/// Inputs that nothing writes, types and qualifiers that differ, names and blocks declared in two ways,
/// places taken twice: errors where OpenGL refuses to link or to draw, warnings where it only surprises.
/// The stages stand in the order of the pipeline.
[[nodiscard]] Diagnostics check_link(const std::vector<StageView>& stages);

/// The part of check_link() that looks at what each stage hands to the next. To Vulkan members of structs
/// have no names.
[[nodiscard]] Diagnostics check_varyings(const std::vector<StageView>& stages, Api api);

/// The part of check_link() that looks at bindings, texture units, locations of uniforms and atomic counters.
[[nodiscard]] Diagnostics check_shared_places(const std::vector<StageView>& stages);

/// Of stages for Vulkan: blocks and samplers that share a place, with both lines, or are not where the family
/// lists them; sets and push constants beyond what every device has, as warnings.
[[nodiscard]] Diagnostics check_descriptors(const std::vector<StageView>& stages, const Family& family);

/// Of stages that are shipped as SPIR-V: specialisation constants that share a constant_id but are not alike,
/// with both lines. The header has one table of them for all stages.
[[nodiscard]] Diagnostics check_constants(const std::vector<StageView>& stages);

/// What the stages need beyond the least that every driver of the dialect offers (OpenGL 4.5 core, tables
/// 23.53 to 23.64; OpenGL 3.3 core, table 6.40 ff.; OpenGL ES 3.0, tables 6.29 to 6.33). Only what is used
/// counts, but for uniform blocks, which are active in any case (OpenGL 4.5, 7.6), and for stated locations.
/// There is at least one stage.
[[nodiscard]] Diagnostics check_limits(const std::vector<StageView>& stages, Dialect dialect);

}  // namespace gobo
