// The relations that a family states, tried on its permutations: what needs no oracle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "family/family.hpp"
#include "lab/raster/pipeline.hpp"
#include "lab/verify/report.hpp"
#include "validate/validate.hpp"

namespace gobo::verify {

/// The stages of a composition, ready to be evaluated. Refers to what it is made of, which must outlive it.
class Decoded {
  public:
    /// Decodes every stage, by `jobs` threads. `validated` must hold their SPIR-V.
    Decoded(const Composition& composition, const Validated& validated, int jobs);

    [[nodiscard]] const Composition& composition() const { return composition_; }
    [[nodiscard]] const Validated& validated() const { return validated_; }
    /// Errors of evaluate::decode().
    [[nodiscard]] const Result<evaluate::Program>& stage(int index) const {
        return programs_[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] StageKind kind_of(int index) const {
        return composition_.stages[static_cast<std::size_t>(index)].kind;
    }
    /// Both stages joined; errors of decoding and of raster::join(), and of a permutation that lacks a stage.
    [[nodiscard]] Result<raster::Pipeline> pipeline(const Permutation& permutation) const;

  private:
    const Composition& composition_;
    const Validated& validated_;
    std::vector<Result<evaluate::Program>> programs_;
};

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

/// The key that the relation compares this one with: of `off` the effect's absence (of a count, one fewer),
/// of `finer` the feature's default. Nothing where there is none or the rules forbid it.
[[nodiscard]] std::optional<Key> partner_of(const Family& family, const Relation& relation, const Key& key,
                                            std::string_view dialect);

/// The keys with which the relations compare these, without those among them, sorted. Only for keys that have
/// no oracle, which says of each by itself what it ought to be.
[[nodiscard]] std::vector<Key> partners(const Family& family, const std::vector<Key>& keys,
                                        std::string_view dialect);

/// Tries each relation that speaks of the permutation, whose pipeline is given, and finds in it what it
/// speaks of; those that compare it with another key, where that is among the composition's. The points are
/// the samples made for the oracle where it knows the key, else drawn from the family's domains.
///
/// Both sides are evaluated in fp64. They may differ by kConditionFactor times what the outputs are known to,
/// as check_alone() measures it, in double roundings. Where an effect is computed per vertex (`finer`), both
/// keys are compared on a coarse and on a fine sphere, lit as `gobo render` shows the family.
[[nodiscard]] Result<std::vector<RelationReport>> try_relations(const Family& family, const Decoded& decoded,
                                                                const Permutation& permutation,
                                                                const raster::Pipeline& pipeline,
                                                                std::uint64_t seed);

}  // namespace gobo::verify
