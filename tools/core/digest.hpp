// Short numbers that stand for long texts.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace gobo {

/// 128 bits that two texts share by no accident (XXH3; it does not withstand who looks for two such texts).
struct Digest {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    friend auto operator<=>(const Digest&, const Digest&) = default;
};

[[nodiscard]] Digest digest_of(std::string_view text);

/// 32 digits: "00ff...".
[[nodiscard]] std::string hex(const Digest& digest);

/// What one version of this program has and every other one lacks: what the linker notes of all that went
/// into it, glslang included, where it does; else the size and the time of its file.
[[nodiscard]] std::string program_identity();

}  // namespace gobo
