// Random numbers that are the same on every machine: the standard library's distributions differ from one to
// the next.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gobo {

/// SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, OOPSLA 2014): any seed
/// gives a good sequence, and every operation on it is exact.
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    [[nodiscard]] std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t mixed = state_;
        mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
        mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
        return mixed ^ (mixed >> 31U);
    }

  private:
    std::uint64_t state_;
};

/// xoshiro256++ of Blackman and Vigna, seeded by SplitMix64 as they advise.
class Xoshiro256 {
  public:
    explicit Xoshiro256(std::uint64_t seed) {
        SplitMix64 bits(seed);
        for (std::uint64_t& word : state_) word = bits.next();
    }

    [[nodiscard]] std::uint64_t next() {
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

  private:
    std::array<std::uint64_t, 4> state_{};
};

/// The upper 53 bits as a number in [0, 1).
[[nodiscard]] inline double unit_interval(std::uint64_t bits) {
    return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// Numbers made of a generator's bits.
template <class Bits>
class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint64_t seed) : generator_(seed) {}

    [[nodiscard]] std::uint64_t bits() { return generator_.next(); }
    /// In [0, 1).
    [[nodiscard]] double unit() { return unit_interval(bits()); }
    /// In [low, high).
    [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
    /// In [low, high), every factor of 10 as likely as any other. Both positive.
    [[nodiscard]] double across(double low, double high) {
        return low * std::exp(std::log(high / low) * unit());
    }
    /// In [low, high].
    [[nodiscard]] int whole(int low, int high) {
        return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    /// True one time in `n`.
    [[nodiscard]] bool one_in(int n) { return whole(1, n) == 1; }
    /// In [0, count); count is at most 2^32.
    [[nodiscard]] std::size_t index(std::size_t count) { return (bits() >> 32U) * count >> 32U; }
    template <class T>
    [[nodiscard]] const T& pick(const std::vector<T>& values) {
        return values[index(values.size())];
    }

  private:
    Bits generator_;
};

}  // namespace gobo
