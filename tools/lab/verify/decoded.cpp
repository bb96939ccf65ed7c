#include "lab/verify/decoded.hpp"

#include "core/parallel.hpp"

namespace gobo::verify {

Decoded::Decoded(const Composition& composition, const Validated& validated, int jobs)
    : composition_(composition), validated_(validated), programs_(validated.stages.size()) {
    parallel_for(jobs, programs_.size(),
                 [&](std::size_t i) { programs_[i] = evaluate::decode(validated.stages[i].spirv); });
}

Result<raster::Pipeline> Decoded::pipeline(const Permutation& permutation) const {
    if (permutation.vertex < 0 || permutation.fragment < 0)
        return fail(Fault::input, "a permutation of one stage has nothing to join");
    GOBO_TRY(const evaluate::Program& vertex, stage(permutation.vertex));
    GOBO_TRY(const evaluate::Program& fragment, stage(permutation.fragment));
    return raster::join(vertex, fragment,
                        validated_.stages[static_cast<std::size_t>(permutation.fragment)].spirv);
}

}  // namespace gobo::verify
