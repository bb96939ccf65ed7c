// Random numbers that are the same on every machine.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace gobo::sanitize {

/// xoshiro256++ of Blackman and Vigna, seeded by their splitmix64. The standard library's distributions
/// differ from one to the next, so they are gobo's own; its generators cost more than the shaders they make
/// inputs for.
class Random {
  public:
    explicit Random(std::uint64_t seed) {
        for (std::uint64_t& word : state_) {
            seed += 0x9e3779b97f4a7c15U;
            std::uint64_t mixed = (seed ^ seed >> 30U) * 0xbf58476d1ce4e5b9U;
            mixed = (mixed ^ mixed >> 27U) * 0x94d049bb133111ebU;
            word = mixed ^ mixed >> 31U;
        }
    }

    /// In [0, 1).
    [[nodiscard]] double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
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
