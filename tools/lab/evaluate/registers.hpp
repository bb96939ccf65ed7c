// What operations work on: a register file in which each slot is a row, one number of each lane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// How integers and booleans lie in a row beside floats T: as wide as those, so that a vector of either is
/// one contiguous run of lanes. Their values are those of 32 bits.
template <class T>
using Int = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;

template <class I>
[[nodiscard]] inline std::int32_t to_signed(I cell) {
    return static_cast<std::int32_t>(cell);
}
template <class I>
[[nodiscard]] inline std::uint32_t to_unsigned(I cell) {
    return static_cast<std::uint32_t>(cell);
}

/// An integer as one of 8 or 16 bits holds it.
template <class I>
[[nodiscard]] I wrapped(I cell, Scalar scalar) {
    switch (scalar) {
        case Scalar::int8:
            return static_cast<std::int8_t>(cell);
        case Scalar::uint8:
            return static_cast<std::uint8_t>(cell);
        case Scalar::int16:
            return static_cast<std::int16_t>(cell);
        case Scalar::uint16:
            return static_cast<std::uint16_t>(cell);
        default:
            return cell;
    }
}

/// Lanes, as bits.
using LaneMask = std::uint64_t;
inline constexpr LaneMask kAllLanes = ~LaneMask{0};
static_assert(kLanes == 64, "a LaneMask has one bit for each lane");

[[nodiscard]] inline bool has_lane(LaneMask lanes, std::size_t lane) {
    return (lanes >> lane & 1U) != 0;
}

template <class Test>
[[nodiscard]] LaneMask lanes_where(const Test& test) {
    LaneMask lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes |= static_cast<LaneMask>(test(lane)) << lane;
    return lanes;
}

template <class T>
class Registers {
  public:
    Registers(const Program& program, const Images& images)
        : program_(program), cells_(std::size_t{program.slots} * kLanes * sizeof(T) + kAlignment) {
        // Rows start at cache lines.
        const auto address = reinterpret_cast<std::uintptr_t>(cells_.data());
        start_ = cells_.data() + (kAlignment - address % kAlignment) % kAlignment;
        for (const ImagePort& port : program.images) {
            const auto given = images.find(port.name);
            images_.push_back(given == images.end() ? nullptr : &given->second);
        }
    }
    Registers(const Registers&) = delete;
    Registers& operator=(const Registers&) = delete;

    [[nodiscard]] T* floats(std::uint32_t slot) {
        return reinterpret_cast<T*>(start_ + std::size_t{slot} * kLanes * sizeof(T));
    }
    /// Rows of the same memory; a slot holds either floats or integers for good, or is copied as bytes.
    [[nodiscard]] Int<T>* ints(std::uint32_t slot) {
        return reinterpret_cast<Int<T>*>(start_ + std::size_t{slot} * kLanes * sizeof(T));
    }
    [[nodiscard]] const std::uint32_t* words(const Operation& operation) const {
        return program_.words.data() + operation.extra;
    }
    /// The caller's image for that ImagePort; where there is none, nullptr, and missing_image() knows.
    [[nodiscard]] const Image* image(std::size_t index) {
        if (index < images_.size() && images_[index] != nullptr) return images_[index];
        missing_image_ = static_cast<int>(index);
        return nullptr;
    }
    /// Index of an image that was asked for in vain, or -1.
    [[nodiscard]] int missing_image() const { return missing_image_; }

    /// What the same invocation wrote to the texel last, if anything; below the first there is none, and such
    /// a one reads as 0 (OpenGL 4.6, 8.26).
    [[nodiscard]] std::optional<std::array<double, 4>> known_texel(const TexelPlace& place) const {
        if (std::ranges::any_of(place.coordinates, [](int at) { return at < 0; }))
            return std::array<double, 4>{};
        const auto written = std::find_if(written_.rbegin(), written_.rend(),
                                          [&](const WrittenTexel& one) { return one.place == place; });
        return written == written_.rend() ? std::nullopt : std::optional(written->texel);
    }
    void write(const TexelPlace& place, const std::array<double, 4>& texel) {
        written_.push_back({place, texel});
    }
    /// All that has been written since this was called last.
    [[nodiscard]] std::vector<WrittenTexel> take_written() { return std::exchange(written_, {}); }

    /// The lanes that run. Operations compute all lanes where that is cheaper: only stores heed the mask.
    [[nodiscard]] LaneMask active() const { return active_; }
    [[nodiscard]] bool is_active(std::size_t lane) const { return has_lane(active_, lane); }
    void set_active(LaneMask active) {
        if (active == active_) return;
        active_ = active;
        for (std::size_t lane = 0; lane < kLanes; ++lane) mask_row_[lane] = is_active(lane) ? -1 : 0;
    }
    /// The active lanes as rows of all bits or none.
    [[nodiscard]] const Int<T>* mask_row() const { return mask_row_.data(); }

    /// The lanes that are invocations of the caller: neither padding nor helpers.
    LaneMask callers_lanes = kAllLanes;
    std::size_t first_invocation = 0;

  private:
    static constexpr std::size_t kAlignment = 64;
    const Program& program_;
    std::vector<const Image*> images_;
    int missing_image_ = -1;
    std::vector<WrittenTexel> written_;
    std::vector<std::byte> cells_;
    std::byte* start_ = nullptr;
    LaneMask active_ = 0;
    std::array<Int<T>, kLanes> mask_row_{};
};

}  // namespace gobo::evaluate
