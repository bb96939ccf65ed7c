// The relations that a family states, tried on its permutations: what needs no oracle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "family/family.hpp"
#include "lab/verify/pipeline.hpp"
#include "lab/verify/report.hpp"

namespace gobo::verify {

/// The worst point at which a relation does not hold: what the stage that shows it was given on either side.
struct BrokenPoint {
    StageKind stage = StageKind::fragment;
    evaluate::EvalPoint one;
    evaluate::EvalPoint other;
};

/// One relation tried on one permutation.
struct RelationReport {
    std::size_t relation = 0;  ///< index into Family::relations
    std::size_t points = 0;
    std::size_t edges = 0;  ///< of them, so near a discontinuity that the sides may differ
    std::size_t failed = 0;
    std::string found;  ///< where it fails: what was found instead
    std::optional<BrokenPoint> worst;
};

/// Points at which each relation is tried: as many as are evaluated at a time.
inline constexpr std::size_t kRelationPoints = evaluate::kLanes;

/// Whether the relation speaks of the key, so far as its condition and its feature say.
[[nodiscard]] bool speaks_of(const Relation& relation, const Key& key);

/// The key that the relation compares this one with: of `off` the effect's absence (of a count, one fewer),
/// of `finer` the feature's default. Nothing where there is none or the rules forbid it.
[[nodiscard]] std::optional<Key> partner_of(const Family& family, const Relation& relation, const Key& key,
                                            std::string_view dialect);

/// The keys with which the relations compare these, without those among them, sorted. Only for keys that have
/// no oracle, which says of each by itself what it ought to be.
[[nodiscard]] std::vector<Key> partners(const Family& family, const std::vector<Key>& keys,
                                        std::string_view dialect);

/// Tries one relation, but for `finer`, at the points. `partner` is the pipeline of partner_of(), where the
/// relation needs one. Nothing where the stages do not have what the relation speaks of.
///
/// Both sides are evaluated in fp64. They may differ by kConditionFactor times what the outputs are known to,
/// as check_alone() measures it, in double roundings.
[[nodiscard]] Result<std::optional<RelationReport>> try_relation(const Family& family, std::size_t relation,
                                                                 const Key& key, const Pipeline& pipeline,
                                                                 const Pipeline* partner,
                                                                 const evaluate::Invocations& points,
                                                                 std::uint64_t seed);

}  // namespace gobo::verify
