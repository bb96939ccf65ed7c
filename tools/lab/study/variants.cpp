#include "lab/study/variants.hpp"

#include <algorithm>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compose/compose.hpp"
#include "family/key.hpp"
#include "validate/validate.hpp"
#include "lab/verify/parallel.hpp"

namespace gobo::study {
namespace {

Result<Variant> decode(const Validated& validated, const Permutation& permutation) {
    if (permutation.vertex < 0 || permutation.fragment < 0)
        return fail(Fault::input, "a study needs a vertex stage and a fragment stage");
    const SpirvModule& vertex = validated.stages[static_cast<std::size_t>(permutation.vertex)].spirv;
    const SpirvModule& fragment = validated.stages[static_cast<std::size_t>(permutation.fragment)].spirv;
    Result<verify::SoftwareProgram> program = verify::software_program(vertex, fragment);
    if (!program) return tl::unexpected(program.error());
    Variant variant;
    variant.key = permutation.key;
    variant.program = std::move(*program);
    variant.interface = interface_of(validated, permutation);
    variant.hash = XXH3_64bits_withSeed(fragment.data(), fragment.size() * sizeof fragment[0],
                                        XXH3_64bits(vertex.data(), vertex.size() * sizeof vertex[0]));
    return variant;
}

}  // namespace

Result<Variants> load_variants(const Family& family, const SearchPath& search, std::vector<Key> keys,
                               int jobs) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    Result<Composition> composition = compose(family, keys, search, Dialect::own);
    if (!composition) return tl::unexpected(composition.error());
    ValidateOptions options;
    options.jobs = jobs;
    options.keep_spirv = true;
    const Validated validated = validate(family, *composition, options);
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    std::vector<Result<Variant>> decoded(keys.size());
    verify::for_each_index(keys.size(), jobs, [&](std::size_t i) {
        decoded[i] = decode(validated, composition->permutations[i]);
    });
    Variants variants;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!decoded[i]) return tl::unexpected(decoded[i].error());
        variants.index[keys[i]] = i;
        variants.all.push_back(std::move(*decoded[i]));
    }
    variants.composition = std::move(*composition);
    return variants;
}

}  // namespace gobo::study
