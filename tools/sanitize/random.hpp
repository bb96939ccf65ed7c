// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace gobo::sanitize {

/// The generator is the standard's, whose sequence is fixed; its distributions differ between libraries, so
/// they are gobo's own.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// In [0, 1).
    [[nodiscard]] double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    /// In [low, high).
    [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
    /// In [0, count).
    [[nodiscard]] std::size_t index(std::size_t count) { return engine_() % count; }
    /// True one time in `n`.
    [[nodiscard]] bool one_in(std::size_t n) { return index(n) == 0; }
    template <class T>
    [[nodiscard]] const T& pick(const std::vector<T>& values) {
        return values[index(values.size())];
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace gobo::sanitize
