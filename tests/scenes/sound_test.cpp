// Nothing needed is missing: pictures by the permutations that a scene's draws need are those of the
// ubershader with everything on.
#include <gtest/gtest.h>

#include "hung_scene.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "scene_library.hpp"
#include "software_scene.hpp"
#include "uber_values.hpp"

namespace gobo::scene {
namespace {

constexpr int width = 64;
constexpr int height = 48;
constexpr std::size_t views = 3;

/// Whether dropping the light can change anything at all.
bool may_be_seen(const Effect& light) {
    return light.reason.find("faces away") == std::string::npos &&
           light.reason.find("intensity is 0") == std::string::npos &&
           light.reason.find("gives back no light") == std::string::npos;
}

/// Whether the file asks for the effect, be it to be seen or not.
bool is_asked_for(const Scene& scene, const Draw& draw, const Effect& effect) {
    const Overrides overrides = overrides_of(scene, draw);
    const Material& material = material_of(scene, draw);
    const bool is_toon = overrides.toon_levels.value_or(0) > 0;
    if (effect.name == "toon") return is_toon;
    if (effect.name == "specular") return effect.value != "none" && !is_toon;
    if (effect.name == "fog" || effect.name == "probe") return effect.value != "none";
    if (effect.name == "reflection") return overrides.reflection.value_or(0) > 0;
    if (effect.name == "vertex_color") return !primitive_of(scene, draw).colors.empty();
    if (effect.name == "cutout") return material.alpha_mode == AlphaMode::mask;
    if (effect.name.starts_with("shadow of ")) return overrides.shadow.value_or(true);
    return effect.is_in;
}

/// What the draw would need if nothing were out of reach: every light, and whatever the file asks for.
Draw everything_on(const Scene& scene, Draw draw) {
    const std::size_t lights = place_lights(scene).size();
    for (std::size_t i = 0; i < draw.effects.size(); ++i)
        draw.effects[i].is_in = i < lights || is_asked_for(scene, draw, draw.effects[i]);
    return draw;
}

/// The most that what was left out may change: a light that has fallen below the threshold, or ends at its
/// range, and thin fog.
double allowed(const Scene& scene, const Draw& draw, double brightest) {
    const Thresholds thresholds;
    const std::vector<PlacedLight> lights = place_lights(scene);
    const Material& material = material_of(scene, draw);
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = *lights[i].light;
        if (draw.effects[i].is_in || !may_be_seen(draw.effects[i])) continue;
        double most = thresholds.light;
        if (std::isfinite(light.range)) {
            const double fade =
                light.attenuation.x + light.range * (light.attenuation.y + light.range * light.attenuation.z);
            const glm::dvec3 back = material.diffuse + material.strength * material.specular;
            most = std::max(most, std::max({back.r, back.g, back.b}) *
                                      std::max({light.color.r, light.color.g, light.color.b}) / fade);
        }
        sum += most;
    }
    for (const Effect& effect : draw.effects)
        if (effect.name == "fog" && !effect.is_in && effect.reason.find("hides") != std::string::npos)
            sum += thresholds.fog * std::max(1.0, brightest);
    return sum;
}

/// How everything is drawn.
struct Everything {
    SceneShaders shaders;
    std::vector<Object> objects;
};

/// By the ubershader, its lights in one array with switches.
Result<Everything> everything_by_uber(const ShippedFamily& lit, const ShippedFamily& uber, const Scene& scene,
                                      const std::vector<Draw>& draws,
                                      const std::vector<std::optional<DrawKey>>& lit_keys) {
    Everything everything;
    std::vector<std::optional<Key>> keys;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        keys.emplace_back();
        everything.objects.emplace_back();
        if (!lit_keys[i]) continue;
        const Key& key = lit_keys[i]->key;
        EXPECT_LE(lights_of(lit.family, key), kSwitchedLights);
        keys.back() = uber_key(uber.family, lit.family, key, UberLights::switched);
        everything.objects.back() = object_of(scene, draws[i]);
        everything.objects.back().values =
            uber_values(uber.family, lit.family, key, std::move(everything.objects.back().values));
    }
    auto shaders = shaders_of(uber.family, uber.search, draws, keys, Dialect::own, 1);
    if (!shaders) return tl::unexpected(shaders.error());
    everything.shaders = std::move(*shaders);
    return everything;
}

class Sound : public testing::TestWithParam<std::string> {};

TEST_P(Sound, ChosenPermutationsDrawWhatTheUbershaderDraws) {
    const ShippedFamily lit("lit");
    const ShippedFamily uber("uber");
    const Scene scene = hung_scene(GetParam());
    const auto from = vantages(scene, views, width, height);
    const std::vector<Draw> draws = required_effects(scene, eyes_of(from), {});
    const auto chosen = shaders_for_draws(lit.family, lit.search, draws, {}, Dialect::own, 1);
    ASSERT_TRUE(chosen) << to_text(chosen.error());

    std::vector<Draw> full;
    for (const Draw& draw : draws) full.push_back(draw.excluded.empty() ? everything_on(scene, draw) : draw);
    const auto full_keys = keys_for_draws(lit.family, full, {}, "450");
    ASSERT_TRUE(full_keys) << to_text(full_keys.error());
    auto everything = everything_by_uber(lit, uber, scene, full, *full_keys);
    ASSERT_TRUE(everything) << to_text(everything.error());

    const auto chosen_programs = software_programs(*chosen);
    const auto uber_programs = software_programs(everything->shaders);
    ASSERT_TRUE(chosen_programs && uber_programs);
    const std::vector<Object> objects = objects_of(scene, *chosen);
    const auto values = values_beside_scene(lit.family.render);
    const SoftwareImages images = software_images(images_of(scene, draws), objects);
    SoftwareImages uber_images = software_images(images_of(scene, full), everything->objects);
    uber_images.renamed = [&](std::size_t draw, const std::vector<RenderValue>& shadows) {
        const auto& key = (*full_keys)[draw];
        return key ? uber_shadow_values(lit.family, key->key, shadows) : std::vector<RenderValue>{};
    };
    std::size_t seen = 0;
    for (const Vantage& vantage : from) {
        const auto actual =
            draw_in_software(*chosen, *chosen_programs, objects, values, vantage.view, false, images);
        const auto expected = draw_in_software(everything->shaders, *uber_programs, everything->objects,
                                               values, vantage.view, false, uber_images);
        ASSERT_TRUE(actual && expected);
        EXPECT_EQ(actual->draw, expected->draw);
        for (std::size_t i = 0; i < actual->draw.size(); ++i) {
            if (actual->draw[i] < 0) continue;
            ++seen;
            double brightest = 0;
            double error = 0;
            for (std::size_t c = 0; c < 4; ++c) {
                const auto right = static_cast<double>(expected->color.values[4 * i + c]);
                brightest = std::max(brightest, std::abs(right));
                error =
                    std::max(error, std::abs(static_cast<double>(actual->color.values[4 * i + c]) - right));
            }
            const Draw& draw = draws[static_cast<std::size_t>(actual->draw[i])];
            // 1e-6: eight roundings of the brightest channel.
            const double limit = 1e-6 * std::max(1.0, brightest) + allowed(scene, draw, brightest);
            ASSERT_LE(error, limit) << draw.name << ", pixel " << i % width << ", " << i / width;
        }
    }
    if (!chosen->composition.permutations.empty()) {
        EXPECT_GT(seen, 100U);
    }
}

std::string name_of_scene(const testing::TestParamInfo<std::string>& row) {
    std::string name = row.param;
    for (char& character : name)
        if (std::isalnum(static_cast<unsigned char>(character)) == 0) character = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Sound, testing::ValuesIn(shipped_scenes()), name_of_scene);

}  // namespace
}  // namespace gobo::scene
