#include "lab/study/heat_maps.hpp"

#include <algorithm>
#include <cmath>

#include "family/key.hpp"
#include "lab/render/image_file.hpp"
#include "budget/qualities.hpp"
#include "lab/verify/parallel.hpp"

namespace gobo::study {
namespace {

constexpr int kWidth = 192;
constexpr int kHeight = 144;

/// Colours of the scene's points as a picture; what shows no surface is grey.
template <class ColorOf>
Image picture(const ScenePoints& points, const ColorOf& color_of) {
    Image image(kWidth, kHeight, 4);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 4; ++c) image.at(x, y, c) = c == 3 ? 1.0F : 0.2F;
    for (std::size_t o = 0; o < points.objects.size(); ++o) {
        for (std::size_t i = 0; i < points.objects[o].fragments.size(); ++i) {
            const verify::Fragment& fragment = points.objects[o].fragments[i];
            const std::array<double, 3> color = color_of(o, i);
            for (int c = 0; c < 3; ++c)
                image.at(fragment.x, kHeight - 1 - fragment.y, c) =
                    static_cast<float>(color[static_cast<std::size_t>(c)]);
        }
    }
    return image;
}

double largest_difference(const Color& a, const Color& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

Result<HeatMap> heat_map(const Family& family, const ScenePoints& points, const Variant& variant) {
    const auto colors = shade_points<float>(points, variant);
    if (!colors) return tl::unexpected(colors.error());
    HeatMap map;
    map.quality = quality_text(family, variant.key);
    map.image = picture(points, [&](std::size_t o, std::size_t i) {
        const double error = largest_difference((*colors)[o][i], points.objects[o].reference[i]);
        map.largest = std::max(map.largest, error);
        return heat_color(error);
    });
    return map;
}

}  // namespace

std::array<double, 3> heat_color(double error) {
    if (std::isnan(error)) error = kHottest;
    const double heat =
        std::clamp(std::log(std::max(error, kCoolest) / kCoolest) / std::log(kHottest / kCoolest), 0.0, 1.0);
    // sRGB anchors whose lightness rises evenly, so that the order shows in grey as well.
    constexpr std::array<std::array<double, 3>, 5> anchors = {
        {{0.05, 0.03, 0.20}, {0.15, 0.25, 0.50}, {0.15, 0.50, 0.50}, {0.45, 0.75, 0.35}, {1.00, 0.95, 0.45}}};
    const double at = heat * (anchors.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
    std::array<double, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = linear_of_srgb(
            std::lerp(anchors[below][c], anchors[below + 1][c], at - static_cast<double>(below)));
    return color;
}

Result<std::vector<HeatMap>> draw_heat_maps(const FileSystem& shipped, const Family& family,
                                            const SearchPath& search, const StudyPlan& plan, int jobs) {
    const Result<DrawnScene> scene = draw_scene(shipped, family, plan.scenes.front(), kWidth, kHeight);
    if (!scene) return tl::unexpected(scene.error());
    const Result<Key> effects = parse_key(family, plan.quick.back());
    if (!effects) return tl::unexpected(effects.error());
    std::vector<Key> keys = {most_accurate(family, *effects)};
    for (const Choice& choice : single_choices(family, *effects)) keys.push_back(choice.key);
    const Result<Variants> variants = load_variants(family, search, keys, jobs);
    if (!variants) return tl::unexpected(variants.error());
    const auto points = find_points(family, variants->at(keys.front()), *scene);
    if (!points) return tl::unexpected(points.error());
    std::vector<HeatMap> maps(1);
    maps.front().image =
        picture(*points, [&](std::size_t o, std::size_t i) { return points->objects[o].reference[i]; });
    std::vector<Result<HeatMap>> made(keys.size());
    verify::for_each_index(keys.size(), jobs, [&](std::size_t i) {
        if (i > 0) made[i] = heat_map(family, *points, variants->at(keys[i]));
    });
    for (std::size_t i = 1; i < made.size(); ++i) {
        if (!made[i]) return tl::unexpected(made[i].error());
        maps.push_back(std::move(*made[i]));
    }
    return maps;
}

}  // namespace gobo::study
