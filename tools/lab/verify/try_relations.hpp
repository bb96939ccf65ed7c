// All relations that a family states, tried on one permutation.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/verify/decoded.hpp"
#include "lab/verify/relations.hpp"

namespace gobo::verify {

/// Tries each relation that speaks of the permutation and finds in it what it speaks of; those that compare
/// it with another key, where that is among the composition's. The points are the samples made for the oracle
/// where it knows the key, else drawn from the family's domains.
[[nodiscard]] Result<std::vector<RelationReport>> try_relations(const Family& family, const Decoded& decoded,
                                                                const Permutation& permutation,
                                                                std::uint64_t seed);

}  // namespace gobo::verify
