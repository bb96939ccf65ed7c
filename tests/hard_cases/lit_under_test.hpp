// Permutations of `lit`, shaded at one point of a surface: vertex stage, then fragment stage, watched.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/sanitize/machine.hpp"

namespace gobo {

/// Numbers by reflected name; "PointLights.lights[].color" is of every light, overruled
/// by "PointLights.lights[2].color".
using Inputs = std::map<std::string, std::vector<double>, std::less<>>;

/// What floats hold of the numbers, so that every mode is given the same.
[[nodiscard]] std::vector<double> as_floats(std::vector<double> numbers);

/// Pieces that take the place of the shipped ones, by include path: "fog/linear.glsl".
using Overlay = std::map<std::string, std::string, std::less<>>;

/// How the stages are evaluated: on one of the machines that GLSL allows, or in double precision.
using Mode = std::optional<sanitize::Machine>;
inline constexpr Mode kDouble = std::nullopt;

/// What came of a point.
struct Shaded {
    std::array<double, 4> color{};
    std::optional<double> depth;  ///< where the permutation writes one
    bool is_discarded = false;
    std::vector<std::string> traps;
};

/// One invocation of each stage.
struct StageInputs {
    evaluate::Invocations vertex;
    evaluate::Invocations fragment;
};

/// The stages of the keys that a condition selects, compiled as they are run. Those of the same arguments are
/// composed once in a process, stages of the same text compiled once.
class LitUnderTest {
  public:
    /// All valid keys for which `where` holds and that have at most one light, ranging over `over`; failing
    /// any step fails the test.
    /// With `cover`, fewer keys that hold every combination of that many feature values. `family` extends
    /// `lit`.
    LitUnderTest(const std::string& where, const std::vector<std::string>& over, const Overlay& overlay,
                 int cover = 0, const std::string& family = "lit");

    [[nodiscard]] std::size_t size() const { return composition().permutations.size(); }
    [[nodiscard]] std::string key(std::size_t permutation) const;
    /// A white surface at (0, 0, -5) that faces the viewer, lights in front of it; `inputs` overrule that.
    /// The fragment stage is given what the vertex stage writes, unless `inputs` name it.
    [[nodiscard]] Shaded shade(std::size_t permutation, const Inputs& inputs, Mode mode) const;
    /// The same without watching for traps.
    [[nodiscard]] Shaded shade_unwatched(std::size_t permutation, const Inputs& inputs, Mode mode) const;
    /// What shade() gives the two stages.
    [[nodiscard]] StageInputs inputs_of(std::size_t permutation, const Inputs& inputs, Mode mode) const;

    [[nodiscard]] const Composition& composition() const { return composed_->composition; }
    [[nodiscard]] const evaluate::Program& vertex(std::size_t permutation) const;
    [[nodiscard]] const evaluate::Program& fragment(std::size_t permutation) const;
    /// A stage's SPIR-V for OpenGL, as drivers are given it.
    [[nodiscard]] std::vector<std::uint32_t> spirv(std::size_t permutation, StageKind kind) const;

    /// What the arguments select.
    struct Composed {
        Family family;
        Composition composition;
        /// Of each stage of the composition; null until it is first asked for: whoever stops at the first
        /// fault compiles little.
        std::vector<const evaluate::Program*> programs;
    };

  private:
    [[nodiscard]] const evaluate::Program& program(int stage) const;

    std::shared_ptr<Composed> composed_;
};

}  // namespace gobo
