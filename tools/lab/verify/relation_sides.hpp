// The two sides of a relation: what a pipeline is given on either, so that its outputs must be the same.
#pragma once

#include <optional>

#include "family/family.hpp"
#include "lab/evaluate/evaluate.hpp"

namespace gobo::verify {

struct Sides {
    evaluate::Invocations one;
    evaluate::Invocations other;
};

/// The sides of a relation made from points. `ports` are what the pipeline is given; `count` is the value of
/// the relation's feature, where that is a count. Nothing where the pipeline has no such array or name.
[[nodiscard]] std::optional<Sides> sides_of(const Relation& relation,
                                            const std::vector<evaluate::Port>& ports, int count,
                                            const evaluate::Invocations& points, std::uint64_t seed);

}  // namespace gobo::verify
