// Nothing built is superfluous: taking an effect away from a draw changes a picture from somewhere.
#include <map>

#include <gtest/gtest.h>

#include "hung_scene.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "scene_library.hpp"
#include "software_scene.hpp"

namespace gobo::scene {
namespace {

constexpr int width = 40;
constexpr int height = 30;
constexpr std::size_t places = 20;
/// Half a step of an 8-bit picture, as the thresholds of effects are: what changes less cannot be seen.
constexpr float visible = 1.0F / 512;

/// One draw without one of its effects.
struct Removal {
    std::size_t draw;
    std::size_t effect;
    Draw without;
    bool matters = false;
};

/// All removals that give another key: effects that the family does not shade are none.
std::vector<Removal> removals_of(const Family& lit, const std::vector<Draw>& draws) {
    std::vector<Removal> removals;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        for (std::size_t k = 0; k < draws[i].effects.size(); ++k) {
            if (!draws[i].effects[k].is_in) continue;
            Removal removal{i, k, draws[i]};
            removal.without.effects[k].is_in = false;
            // A light takes its shadow with it.
            for (Effect& effect : removal.without.effects)
                if (effect.name == "shadow of " + draws[i].effects[k].name) effect.is_in = false;
            const auto keys = keys_for_draws(lit, {draws[i], removal.without}, {}, "450");
            if (keys && (*keys)[0]->key != (*keys)[1]->key) removals.push_back(std::move(removal));
        }
    }
    return removals;
}

/// The draws, and behind them every removal's.
struct Variants {
    SceneShaders shaders;
    SoftwarePrograms programs;
    std::vector<Object> objects;
    SoftwareImages images;
};

Variants variants_of(const ShippedFamily& lit, const Scene& scene, const std::vector<Draw>& draws,
                     const std::vector<Removal>& removals) {
    std::vector<Draw> all = draws;
    for (const Removal& removal : removals) all.push_back(removal.without);
    Variants variants;
    auto shaders = shaders_for_draws(lit.family, lit.search, all, {}, Dialect::own, 1);
    EXPECT_TRUE(shaders) << to_text(shaders.error());
    variants.shaders = std::move(*shaders);
    variants.programs = *software_programs(variants.shaders);
    variants.objects = objects_of(scene, variants.shaders);
    variants.images = software_images(images_of(scene, all), variants.objects);
    return variants;
}

/// The picture of the variants of those numbers.
SoftwarePicture picture(const Variants& variants, const std::vector<std::size_t>& numbers,
                        const std::vector<RenderValue>& values, const SceneView& view) {
    SceneShaders shaders = variants.shaders;
    for (auto& permutation : shaders.permutation) permutation.reset();
    for (const std::size_t number : numbers)
        shaders.permutation[number] = variants.shaders.permutation[number];
    auto drawn =
        draw_in_software(shaders, variants.programs, variants.objects, values, view, false, variants.images);
    EXPECT_TRUE(drawn) << to_text(drawn.error());
    return std::move(*drawn);
}

bool pixel_differs(const SoftwarePicture& a, const SoftwarePicture& b, std::size_t pixel) {
    for (std::size_t c = 0; c < 4; ++c)
        if (std::abs(a.color.values[4 * pixel + c] - b.color.values[4 * pixel + c]) > visible) return true;
    return false;
}

/// Whether the draw's visible pixels differ.
bool differ(const SoftwarePicture& whole, const SoftwarePicture& alone, std::size_t draw) {
    for (std::size_t i = 0; i < whole.draw.size(); ++i)
        if (whole.draw[i] == static_cast<int>(draw) && pixel_differs(whole, alone, i)) return true;
    return false;
}

/// Whether any pixel differs: what cuts holes changes those that the draw leaves to others.
bool differ(const SoftwarePicture& a, const SoftwarePicture& b) {
    for (std::size_t i = 0; i < a.draw.size(); ++i)
        if (pixel_differs(a, b, i)) return true;
    return false;
}

void try_from(const Vantage& vantage, const Variants& variants, const std::vector<RenderValue>& values,
              std::size_t draws, std::vector<Removal>& removals) {
    std::vector<std::size_t> everything(draws);
    for (std::size_t i = 0; i < draws; ++i) everything[i] = i;
    const SoftwarePicture whole = picture(variants, everything, values, vantage.view);
    for (std::size_t i = 0; i < removals.size(); ++i) {
        if (removals[i].matters) continue;
        const SoftwarePicture alone = picture(variants, {draws + i}, values, vantage.view);
        std::vector<std::size_t> without = everything;
        without[removals[i].draw] = draws + i;
        removals[i].matters = differ(whole, alone, removals[i].draw) ||
                              differ(whole, picture(variants, without, values, vantage.view));
    }
}

struct Tally {
    std::size_t kept = 0;
    std::vector<std::string> superfluous;
};

Tally tally(const std::string& file) {
    const ShippedFamily lit("lit");
    const Scene scene = hung_scene(file);
    const auto from = vantages(scene, places, width, height);
    const std::vector<Draw> draws = required_effects(scene, eyes_of(from), {});
    std::vector<Removal> removals = removals_of(lit.family, draws);
    if (removals.empty()) return {};
    const Variants variants = variants_of(lit, scene, draws, removals);
    const auto values = values_beside_scene(lit.family.render);
    for (const Vantage& vantage : from) {
        const bool is_done = std::all_of(removals.begin(), removals.end(),
                                         [](const Removal& removal) { return removal.matters; });
        if (!is_done) try_from(vantage, variants, values, draws.size(), removals);
    }
    Tally result{removals.size(), {}};
    for (const Removal& removal : removals)
        if (!removal.matters)
            result.superfluous.push_back(file + ", " + draws[removal.draw].name + ": " +
                                         draws[removal.draw].effects[removal.effect].name);
    return result;
}

/// Effects that are kept though nothing is seen of them, each with its cause.
const std::map<std::string, std::string> exceptions = {
    {"made/lamp_shadows.gltf, box: shadow of spot 1",
     "the ball's bounds reach between, its shadow falls beside the box"},
    {"others/boxTexcoords.gltf, Cube: sides", "it is closed: its back is never seen"},
    {"made/lamp.gltf, box: specular", "flat faces mirror the lamp to where none of the places is"},
};

TEST(Tight, KeptEffectsMatter) {
    std::size_t kept = 0;
    std::vector<std::string> superfluous;
    for (const std::string& file : shipped_scenes()) {
        const Tally one = tally(file);
        kept += one.kept;
        superfluous.insert(superfluous.end(), one.superfluous.begin(), one.superfluous.end());
    }
    for (const std::string& effect : superfluous)
        EXPECT_TRUE(exceptions.contains(effect))
            << effect << " changes no pixel from " << places << " places";
    for (const auto& [effect, cause] : exceptions)
        EXPECT_NE(std::find(superfluous.begin(), superfluous.end(), effect), superfluous.end())
            << effect << " is an exception no longer";
    EXPECT_LE(10 * superfluous.size(), kept);
    RecordProperty("kept", static_cast<int>(kept));
    std::printf("%zu effects kept, %zu of them without effect\n", kept, superfluous.size());
}

}  // namespace
}  // namespace gobo::scene
