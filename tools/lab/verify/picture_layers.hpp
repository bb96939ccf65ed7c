// The fragments of a picture, each shaded, in the order in which they are drawn.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lab/verify/shade.hpp"

namespace gobo::verify {

using Color = std::array<double, 4>;

/// Depths this near to one another may be ordered either way: some twenty roundings of a depth near 1.
inline constexpr double kDepthError = 2e-6;

/// A fragment as one evaluation shaded it.
struct Candidate {
    const Fragment* fragment = nullptr;
    Shaded shaded;
    Color spread{};  ///< of its colour: interpolation_spread()
};

/// What a pixel may show.
struct Seen {
    Color color{};
    Color spread{};
};

/// The candidates of each pixel. Refers to the objects' fragments, which must outlive it.
class Layers {
  public:
    Layers(int width, int height)
        : width_(width), at_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    void add(const SoftwareObject& object, const std::vector<Shaded>& shaded,
             const std::vector<Color>& spread = {});
    /// Pixels are counted from the lower left.
    [[nodiscard]] const std::vector<Candidate>& at(int x, int y) const { return at_[index(x, y)]; }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    int width_;
    std::vector<std::vector<Candidate>> at_;
};

/// Shades every object, nudged.
[[nodiscard]] Result<Layers> shade_all(const SoftwareProgram& program,
                                       const std::vector<SoftwareObject>& objects, const Nudge& nudge = {});

/// Shades every object, and finds how far its colours may be off by errors of interpolation.
[[nodiscard]] Result<Layers> shade_with_spread(const SoftwareProgram& program,
                                               const std::vector<SoftwareObject>& objects);

/// What the depth test leaves; nothing is the background.
[[nodiscard]] std::optional<Seen> visible(const std::vector<Candidate>& candidates);

/// All that the pixel may show where each fragment near an edge may be covered or not, and depths that are
/// almost the same may be ordered either way.
[[nodiscard]] std::vector<Seen> possible(const std::vector<Candidate>& candidates, const Color& background);

}  // namespace gobo::verify
