// The relation `finer`: on finer meshes a key that computes more per vertex approaches one that does not.
#pragma once

#include <optional>

#include "core/diagnostic.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"
#include "lab/verify/pipeline.hpp"

namespace gobo::verify {

/// A permutation with what the family's [render] values need to reach it.
struct Drawable {
    const Pipeline& pipeline;
    const Interface& interface;
};

/// How far two keys are apart, by the root mean square of their colours at the centres of a sphere's
/// triangles, in fp64, lit as `gobo render` shows the family.
struct Approach {
    double coarse = 0;  ///< a sphere of 8 stacks
    double fine = 0;    ///< of 32
    std::size_t triangles = 0;
    [[nodiscard]] bool holds() const;
};

/// A mesh four times as fine must at least come this much nearer. What is interpolated linearly is off by the
/// square of an edge's length, a sixteenth; what is flat by its length, a quarter; and where a band's or a
/// cone's rim runs through triangles, by the root of their share, a half, which meshes that do not fall on it
/// alike make a little more.
inline constexpr double kNearer = 0.7;

[[nodiscard]] Result<Approach> approach(const Drawable& one, const Drawable& other,
                                        const std::vector<RenderValue>& values);

}  // namespace gobo::verify
