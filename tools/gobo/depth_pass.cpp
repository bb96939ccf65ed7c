#include "gobo/depth_pass.hpp"

#include <algorithm>

#include "render/lit_shadows.hpp"
#include "validate/validate.hpp"

namespace gobo {

bool has_shadows(const Family& family, const Composition& composition) {
    return std::any_of(
        composition.permutations.begin(), composition.permutations.end(),
        [&](const Permutation& permutation) { return !shadow_lights(family, permutation.key).empty(); });
}

Result<DepthPass> load_depth_pass(const World& world, const CommonOptions& options) {
    Result<LoadedFamily> family = load_family(world, "depth", options);
    if (!family) return tl::unexpected(family.error());
    const auto composition = load_composition(world, *family, {}, Dialect::own);
    if (!composition) return tl::unexpected(composition.error());
    const Validated validated = validate(family->family, *composition, {});
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    const Permutation& permutation = composition->permutations.front();
    DepthPass pass;
    pass.stages = {stage_text(*composition, permutation.vertex),
                   stage_text(*composition, permutation.fragment)};
    pass.interface = interface_of(validated, permutation);
    pass.values = family->family.render;
    return pass;
}

}  // namespace gobo
