#include "lab/scene_picture/picture_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "lab/render/image.hpp"

namespace gobo::scene {
namespace {

constexpr std::size_t kChannels = 4;
constexpr std::size_t kAlpha = 3;

/// The texels that one of the smaller level covers along a side: two, or three where the side is odd.
struct Covered {
    int first = 0;
    int count = 0;
    std::array<double, 3> weights{};  ///< together 1
};

/// What each texel of the smaller side covers. Lengths are counted in parts of which a larger texel has as
/// many as there are smaller ones.
std::vector<Covered> covered_along(int larger, int smaller) {
    std::vector<Covered> all;
    for (std::int64_t i = 0; i < smaller; ++i) {
        const std::int64_t begin = i * larger;
        const std::int64_t end = begin + larger;
        Covered& covered = all.emplace_back();
        covered.first = static_cast<int>(begin / smaller);
        for (std::int64_t texel = covered.first; texel * smaller < end; ++texel) {
            const auto length = std::min(end, (texel + 1) * smaller) - std::max(begin, texel * smaller);
            covered.weights[static_cast<std::size_t>(covered.count++)] = static_cast<double>(length) / larger;
        }
    }
    return all;
}

TextureImage halved(const TextureImage& picture, bool is_srgb) {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linear_of_srgb(static_cast<double>(i) / 255);
    TextureImage half{std::max(picture.width / 2, 1), std::max(picture.height / 2, 1), {}};
    const auto columns = covered_along(picture.width, half.width);
    const auto rows = covered_along(picture.height, half.height);
    half.texels.reserve(columns.size() * rows.size() * kChannels);
    const auto mean = [&](const Covered& column, const Covered& row, std::size_t channel) {
        const bool is_encoded = is_srgb && channel != kAlpha;
        double sum = 0;
        for (int y = 0; y < row.count; ++y)
            for (int x = 0; x < column.count; ++x) {
                const auto texel = static_cast<std::size_t>(row.first + y) * picture.width + column.first + x;
                const std::uint8_t byte = picture.texels[texel * kChannels + channel];
                sum += row.weights[y] * column.weights[x] * (is_encoded ? linear[byte] : byte / 255.0);
            }
        return is_encoded ? srgb_of_linear(std::min(sum, 1.0)) : sum;
    };
    for (const Covered& row : rows)
        for (const Covered& column : columns)
            for (std::size_t channel = 0; channel < kChannels; ++channel)
                half.texels.push_back(
                    static_cast<std::uint8_t>(std::lround(255 * mean(column, row, channel))));
    return half;
}

}  // namespace

std::vector<TextureImage> picture_levels(const TextureImage& picture, bool is_srgb) {
    std::vector<TextureImage> levels = {picture};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved(levels.back(), is_srgb));
    return levels;
}

std::vector<TextureImage> levels_within(int most, std::vector<TextureImage> levels, Diagnostics& warnings) {
    const auto first = std::ranges::find_if(
        levels, [&](const TextureImage& level) { return std::max(level.width, level.height) <= most; });
    if (first == levels.begin()) return levels;
    Diagnostic& warning = warnings.emplace_back();
    warning.severity = Severity::warning;
    warning.message =
        fmt::format("a picture of {} x {} texels is drawn by {} x {}: the renderer's largest side is {}",
                    levels.front().width, levels.front().height, first->width, first->height, most);
    levels.erase(levels.begin(), first);
    return levels;
}

AlphaMap alpha_map_within(int most, const std::vector<AlphaMap>& maps, std::size_t draw,
                          Diagnostics& warnings) {
    if (draw >= maps.size() || maps[draw].texels.empty()) return {1, 1, {255}};
    const AlphaMap& map = maps[draw];
    TextureImage picture{map.width, map.height, {}};
    for (const std::uint8_t alpha : map.texels) picture.texels.insert(picture.texels.end(), 4, alpha);
    const TextureImage level = levels_within(most, picture_levels(picture, false), warnings).front();
    AlphaMap result{level.width, level.height, {}};
    for (std::size_t i = 3; i < level.texels.size(); i += 4) result.texels.push_back(level.texels[i]);
    return result;
}

}  // namespace gobo::scene
