// Random numbers that are the same on every machine.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/random.hpp"

namespace gobo::sanitize {

/// xoshiro256++ of Blackman and Vigna, seeded by SplitMix64 as they advise. The standard library's generators
/// cost more than the shaders they make inputs for.
class Random {
  public:
    explicit Random(std::uint64_t seed) {
        SplitMix64 bits(seed);
        for (std::uint64_t& word : state_) word = bits.next();
    }

    /// In [0, 1).
    [[nodiscard]] double unit() { return unit_interval(next()); }
    /// In [low, high).
    [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
    /// In [0, count); count is at most 2^32.
    [[nodiscard]] std::size_t index(std::size_t count) { return (next() >> 32U) * count >> 32U; }
    /// True one time in `n`.
    [[nodiscard]] bool one_in(std::size_t n) { return index(n) == 0; }
    template <class T>
    [[nodiscard]] const T& pick(const std::vector<T>& values) {
        return values[index(values.size())];
    }

  private:
    std::uint64_t next() {
        auto& [a, b, c, d] = state_;
        const std::uint64_t result = std::rotl(a + d, 23) + a;
        const std::uint64_t shifted = b << 17U;
        c ^= a;
        d ^= b;
        b ^= c;
        a ^= d;
        c ^= shifted;
        d = std::rotl(d, 45);
        return result;
    }

    std::array<std::uint64_t, 4> state_{};
};

}  // namespace gobo::sanitize
