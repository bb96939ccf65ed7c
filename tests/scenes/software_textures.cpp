#include "software_textures.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lab/scene_picture/picture_levels.hpp"

namespace gobo::scene {
namespace {

using Color = std::array<double, 4>;

struct Level {
    int width = 0;
    int height = 0;
    std::vector<Color> texels;

    [[nodiscard]] const Color& at(int x, int y) const {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

constexpr int kMirroredRepeat = 33648;
constexpr int kClampToEdge = 33071;

/// OpenGL 4.5, table 8.20.
int wrapped(double index, int count, int wrap) {
    if (wrap == kClampToEdge) return static_cast<int>(std::clamp(index, 0.0, count - 1.0));
    const double period = wrap == kMirroredRepeat ? 2.0 * count : count;
    const int inside = static_cast<int>(index - std::floor(index / period) * period);
    return inside < count ? inside : 2 * count - 1 - inside;
}

constexpr int kNearest = 9728;
constexpr int kLinear = 9729;
constexpr int kNearestOfNearestLevel = 9984;
constexpr int kLinearOfNearestLevel = 9985;
constexpr int kNearestBetweenLevels = 9986;

bool is_nearest_within_level(int min_filter) {
    return min_filter == kNearest || min_filter == kNearestOfNearestLevel ||
           min_filter == kNearestBetweenLevels;
}

/// Which level is looked up, between two where it is no whole number (OpenGL 4.5, 8.14.3).
double level_of(int min_filter, double lod) {
    if (min_filter == kNearest || min_filter == kLinear) return 0;
    if (min_filter == kNearestOfNearestLevel || min_filter == kLinearOfNearestLevel)
        return std::ceil(lod + 0.5) - 1;
    return lod;
}

/// The four texels around a place in texels.
Color filtered(const Level& level, double x, double y, int wrap_s, int wrap_t) {
    const double left = std::floor(x - 0.5);
    const double lower = std::floor(y - 0.5);
    const double across = x - 0.5 - left;
    const double up = y - 0.5 - lower;
    Color color{};
    for (int i = 0; i < 4; ++i) {
        const Color& texel = level.at(wrapped(left + i % 2, level.width, wrap_s),
                                      wrapped(lower + i / 2, level.height, wrap_t));
        const double weight = (i % 2 == 1 ? across : 1 - across) * (i / 2 == 1 ? up : 1 - up);
        for (std::size_t c = 0; c < 4; ++c) color[c] += weight * texel[c];
    }
    return color;
}

std::vector<Level> levels_of(const PictureUse& use) {
    std::vector<Level> levels;
    for (const TextureImage& picture : picture_levels(*use.picture, use.is_srgb)) {
        Level& level = levels.emplace_back(Level{picture.width, picture.height, {}});
        for (std::size_t i = 0; i < picture.texels.size(); i += 4) {
            Color& color = level.texels.emplace_back();
            for (std::size_t c = 0; c < 4; ++c) {
                const double signal = picture.texels[i + c] / 255.0;
                color[c] = use.is_srgb && c < 3 ? linear_of_srgb(signal) : signal;
            }
        }
    }
    return levels;
}

}  // namespace

evaluate::Image picture_image(const PictureUse& use) {
    return [levels = std::make_shared<const std::vector<Level>>(levels_of(use)),
            how = *use.use](const evaluate::ImageRequest& request) -> Color {
        const Level& whole = levels->front();
        if (request.what == evaluate::ImageRequest::What::size)
            return {static_cast<double>(whole.width), static_cast<double>(whole.height), 1, 1};
        const auto length = [&](const std::array<double, 3>& along) {
            return std::hypot(along[0] * whole.width, along[1] * whole.height);
        };
        const double texels = std::max({length(request.dx), length(request.dy), 1e-9});
        const double lod = request.has_lod ? request.lod : std::log2(texels);
        const auto sampled = [&](double number) {
            const Level& level = (*levels)[static_cast<std::size_t>(number)];
            const double x = request.coordinates[0] * level.width;
            const double y = request.coordinates[1] * level.height;
            if (lod <= 0 ? how.is_nearest : is_nearest_within_level(how.min_filter))
                return level.at(wrapped(std::floor(x), level.width, how.wrap_s),
                                wrapped(std::floor(y), level.height, how.wrap_t));
            return filtered(level, x, y, how.wrap_s, how.wrap_t);
        };
        const double held = level_of(how.min_filter, std::clamp(lod, 0.0, levels->size() - 1.0));
        const double finer = std::floor(held);
        Color color = sampled(finer);
        if (finer == held) return color;
        const Color coarser = sampled(finer + 1);
        for (std::size_t c = 0; c < 4; ++c) color[c] = std::lerp(color[c], coarser[c], held - finer);
        return color;
    };
}

}  // namespace gobo::scene
