// Every trap of every operation of a composition: impossible on all inputs of the domain, possible by an
// example, or undecided.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "core/result_cache.hpp"
#include "family/family.hpp"
#include "lab/prove/range.hpp"
#include "lab/sanitize/finding.hpp"
#include "validate/validate.hpp"

namespace gobo::prove {

struct ProveOptions {
    int jobs = 1;             ///< threads
    std::size_t splits = 40;  ///< parts of the domain that are looked at for one rule at one place, at most
    std::size_t points =
        32768;  ///< inputs that a stage gets in search of an example, where anything is undecided
    std::uint64_t seed = 1;
    std::size_t check = 0;         ///< inputs over all stages that the proofs are held to
    ResultCache* cache = nullptr;  ///< where a stage's proof is kept from one run to the next; null: nowhere
};

enum class Status { impossible, undecided, possible };

/// An input, or a component of it, and the part of its domain that is left.
struct PartLeft {
    std::string name;  ///< "Fog.start", "eyeNormal[0]"
    Range range;
};

/// A trap of a source operation, on all keys and in all turns of loops.
struct ProvenRule {
    std::string message;  ///< "division by zero"
    Status status = Status::impossible;
    bool ignores_tiny =
        false;  ///< impossible where no input is nearer to 0 than sanitize::kSmallest, but 0 itself
    bool is_of_results = false;  ///< infinity or NaN made from finite numbers
    std::string key;             ///< one of those with the stage that is not proven first; empty of files
    std::string reason;          ///< why undecided
    std::vector<PartLeft> left;  ///< the smallest part of the domain that is left, where undecided
    std::size_t stage = 0;       ///< index into Composition::stages, of the first that is not proven
    sanitize::Finding example;   ///< where possible
};

/// What stands in one line of a piece under one name.
struct SourceOperation {
    Place place;
    std::string name;         ///< "FDiv"
    bool is_constant = true;  ///< what decides its traps are constants, everywhere
    std::vector<ProvenRule> rules;
    std::vector<std::size_t> stages;  ///< indices into Composition::stages

    [[nodiscard]] bool is_proven() const;
    /// Has a rule of its own beside those of all arithmetic.
    [[nodiscard]] bool has_own_rule() const;
};

/// What a stage's output may hold, over all keys, and what the family says of it.
struct OutputRange {
    StageKind stage = StageKind::vertex;
    std::string name;  ///< "eyeNormal", "lightRays[]"
    Range range;
    bool is_stated = false;
    bool is_of_length = false;  ///< the range stated is of the vector's length
    double stated_low = 0;
    double stated_high = 0;

    [[nodiscard]] bool is_within() const {
        return !range.nan && range.low >= stated_low && range.high <= stated_high;
    }
};

struct ProveReport {
    std::vector<SourceOperation> operations;  ///< by place and name
    std::vector<OutputRange> outputs;         ///< by stage and name
    Diagnostics diagnostics;                  ///< why nothing is known of a stage
    std::size_t stages = 0;
    std::size_t permutations = 0;
    std::size_t points = 0;  ///< that the proofs were held to
};

/// `validated` must hold the SPIR-V of every stage, with debug information, so that places are known.
[[nodiscard]] ProveReport prove(const Family& family, const Composition& composition,
                                const Validated& validated, const ProveOptions& options);

/// Tables of rules, of what is not proven, and of outputs.
[[nodiscard]] std::string proof_text(const ProveReport& report);
[[nodiscard]] std::string proof_json(const ProveReport& report);

}  // namespace gobo::prove
