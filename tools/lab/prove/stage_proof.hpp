// The proof of one stage.
#pragma once

#include <vector>

#include "lab/prove/prove.hpp"
#include "lab/prove/rules.hpp"
#include "lab/sanitize/input_space.hpp"

namespace gobo::prove {

/// A rule at an operation of the program, over all its sites.
struct RuleAtOperation {
    std::uint32_t operation = 0;
    Rule rule;
    bool is_proven = true;
    bool is_constant = true;
    bool ignores_tiny = false;   ///< proven only of inputs that are 0 or not tiny
    std::vector<Cut> left = {};  ///< of the first site not proven: the last part of the domain that was left
};

class StageProof {
  public:
    /// `program` and `space` must outlive it.
    StageProof(const evaluate::Program& program, const sanitize::InputSpace& space);

    /// Proves what it can, splitting the domain into so many parts for a rule at a site at most. Errors: a
    /// stage that cannot be unrolled; then nothing is proven of it.
    [[nodiscard]] Result<void> run(std::size_t splits, bool has_tiny_inputs,
                                   const std::vector<bool>& is_settled = {});

    [[nodiscard]] const std::vector<RuleAtOperation>& rules() const { return rules_; }
    /// Of each component of each output, in the program's order; none of one that is never written.
    [[nodiscard]] const std::vector<std::vector<Range>>& outputs() const { return outputs_; }
    /// Of each operation that has rules or computes anything, what its results may be, over all its sites; of
    /// others none.
    [[nodiscard]] const std::vector<std::vector<Range>>& results() const { return results_; }
    /// What of the inputs is left by the cuts.
    [[nodiscard]] std::vector<PartLeft> inputs_of(const std::vector<Cut>& cuts) const;
    [[nodiscard]] const Expressions& expressions() const { return expressions_; }

  private:
    struct Slice {
        std::vector<bool> is_wanted;
        std::vector<Event> events;
        std::vector<std::uint32_t> candidates;  ///< expressions to split at
    };
    [[nodiscard]] Slice slice_for(const Site& site) const;
    [[nodiscard]] bool holds(Ranges& ranges, const Slice& slice, const Site& site, const Rule& rule,
                             const std::vector<Cut>& cuts) const;
    [[nodiscard]] bool split(Ranges& ranges, const Slice& slice, const Site& site, const Rule& rule,
                             std::vector<Cut>& cuts, std::size_t& budget, std::size_t depth,
                             std::vector<Cut>& left) const;

    const evaluate::Program& program_;
    const sanitize::InputSpace& space_;
    Expressions expressions_;
    std::vector<RuleAtOperation> rules_;
    std::vector<std::vector<Range>> outputs_;
    std::vector<std::vector<Range>> results_;
};

}  // namespace gobo::prove
