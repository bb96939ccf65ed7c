// The stages of a composition, ready to be evaluated.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "lab/raster/pipeline.hpp"
#include "validate/validate.hpp"

namespace gobo::verify {

/// Refers to what it is made of, which must outlive it.
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

}  // namespace gobo::verify
