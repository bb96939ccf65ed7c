// The questions with two answers that a lighting model asks: where a radiance jumps.
#pragma once

#include <cstdint>

namespace gobo::oracle {

/// Within this distance of an edge, either answer is right: a float's rounding may decide it. It is ten times
/// what sixteen roundings of a unit quantity amount to (16 * 2^-24 = 1e-6).
inline constexpr double kEdgeWidth = 1e-5;

/// Answers questions, keeps how near to the edge the nearest one was, and can be told to give the other
/// answer where both are right. All quantities are of size 1: cosines, versines, ratios of distances.
class Decisions {
  public:
    /// Bit i of `flipped`: the i-th question that lies within kEdgeWidth of its edge gets the other answer.
    explicit Decisions(std::uint32_t flipped = 0) : flipped_(flipped) {}

    /// Whether quantity > edge.
    [[nodiscard]] bool above(double quantity, double edge);

    /// The distance of the nearest deciding quantity from its edge; 2 or more where nothing was asked.
    [[nodiscard]] double nearest() const { return nearest_; }
    /// How many questions lay within kEdgeWidth of their edge.
    [[nodiscard]] int open() const { return open_; }

  private:
    std::uint32_t flipped_;
    double nearest_ = 2;
    int open_ = 0;
};

}  // namespace gobo::oracle
