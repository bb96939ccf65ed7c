// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "core/random.hpp"

namespace gobo {

/// What samples are drawn from.
class Random {
  public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}

    [[nodiscard]] std::uint64_t bits() { return generator_.next(); }
    /// In [0, 1).
    [[nodiscard]] double unit();
    /// In [low, high).
    [[nodiscard]] double between(double low, double high);
    /// In [low, high), every factor of 10 as likely as any other. Both positive.
    [[nodiscard]] double across(double low, double high);
    /// In [low, high].
    [[nodiscard]] int whole(int low, int high);
    /// True one time in `n`.
    [[nodiscard]] bool one_in(int n);
    /// Each component in [low, high).
    [[nodiscard]] glm::dvec3 components(double low, double high);
    /// A unit vector, all directions alike.
    [[nodiscard]] glm::dvec3 direction();

  private:
    SplitMix64 generator_;
};

}  // namespace gobo
