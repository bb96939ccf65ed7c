#include "lab/commands/depth_pass.hpp"

#include <algorithm>

#include "lab/render/shadow_maps.hpp"
#include "validate/validate.hpp"

namespace gobo {

bool has_shadows(const Family& family, const Composition& composition) {
    return std::any_of(
        composition.permutations.begin(), composition.permutations.end(),
        [&](const Permutation& permutation) { return !shadow_lights(family, permutation.key).empty(); });
}

Result<DepthPass> load_depth_pass(const World& world, const CommonOptions& options) {
    auto pass = load_shadow_pass(world, options);
    if (!pass) return tl::unexpected(pass.error());
    return std::move(pass->pass);
}

Result<verify::ShadowPass> load_shadow_pass(const World& world, const CommonOptions& options) {
    Result<LoadedFamily> family = load_family(world, "depth", options);
    if (!family) return tl::unexpected(family.error());
    const auto composition = load_composition(world, *family, {}, Dialect::own);
    if (!composition) return tl::unexpected(composition.error());
    ValidateOptions wanted;
    wanted.keep_spirv = true;
    const Validated validated = validate(family->family, *composition, wanted);
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    const Permutation& permutation = composition->permutations.front();
    verify::ShadowPass result;
    DepthPass& pass = result.pass;
    pass.stages = {stage_text(*composition, permutation.vertex),
                   stage_text(*composition, permutation.fragment)};
    pass.interface = interface_of(validated, permutation);
    pass.values = family->family.render;
    result.vertex = validated.stages[static_cast<std::size_t>(permutation.vertex)].spirv;
    result.fragment = validated.stages[static_cast<std::size_t>(permutation.fragment)].spirv;
    return result;
}

}  // namespace gobo
