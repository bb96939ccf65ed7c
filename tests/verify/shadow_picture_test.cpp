// Shadows as they are drawn, both passes: what is dark, and the two faults of shadow maps at grazing angles
// (hard case: grazing shadow).
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "family/read_family.hpp"
#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

constexpr int kSide = 256;
constexpr double kHeight = 12;        ///< of the camera, straight above
constexpr double kFieldOfView = 0.5;  ///< a square of 6.1 units of the ground

/// A family's key, ready to draw.
struct Drawable {
    std::vector<StageText> stages;
    Interface interface;
    Family family;
    Key key;
};

Drawable compose_drawable(const std::string& family_name, const std::string& key) {
    const std::string path = std::string(GOBO_SOURCE_DIR) + "/templates/" + family_name + ".toml";
    const Family family = read_family(DiskFileSystem().read(path).value(), path).value();
    const Composition composition = compose_lit(family, keys_of(family, {key}), {}).value();
    const Validated validated = validate(family, composition, {});
    const Permutation& permutation = composition.permutations.front();
    return {{stage_text(composition, permutation.stages[StageKind::vertex]),
             stage_text(composition, permutation.stages[StageKind::fragment])},
            interface_of(validated, permutation),
            family,
            permutation.key};
}

/// Composed once.
const Drawable& drawable(std::string_view family_name, std::string_view key) {
    static std::map<std::string, Drawable> known;
    const std::string name = fmt::format("{} {}", family_name, key);
    const auto found = known.find(name);
    return found != known.end()
               ? found->second
               : known.emplace(name, compose_drawable(std::string(family_name), std::string(key)))
                     .first->second;
}

DepthPass depth_pass() {
    const Drawable& depth = drawable("depth", "default");
    DepthPass pass;
    pass.stages = depth.stages;
    pass.interface = depth.interface;
    pass.values = depth.family.render;
    return pass;
}

/// A light of radiance 1 on a white, dull surface without ambient light.
void add_light(Family& family, const std::string& name, const glm::dvec3& place) {
    const auto set = [&](const std::string& value, const std::string& source, std::vector<double> numbers) {
        family.render.push_back({value, source, std::move(numbers), {}});
    };
    set("Material.ambient", "", {0, 0, 0});
    set("Material.diffuse", "", {1, 1, 1});
    if (name == "DirectionalLights") {
        set(name + ".lights[0].direction", "eye_direction", {place.x, place.y, place.z});
        set(name + ".lights[0].color", "", {1, 1, 1});
        return;
    }
    set(name + ".lights[0].position", "eye_point", {place.x, place.y, place.z});
    set(name + ".lights[0].color", "", {1, 1, 1});
    set(name + ".lights[0].attenuation", "", {1, 0, 0});
    if (name != "SpotLights") return;
    const glm::dvec3 axis = -glm::normalize(place);
    set(name + ".lights[0].axis", "eye_direction", {axis.x, axis.y, axis.z});
    set(name + ".lights[0].exponent", "", {0});
    set(name + ".lights[0].innerOneMinusCosine", "", {0.5});
    set(name + ".lights[0].outerOneMinusCosine", "", {0.6});
}

/// The last value given to a name counts; lit_shadows reads the first, so the family's own go.
void drop_lights(Family& family) {
    std::erase_if(family.render,
                  [](const RenderValue& value) { return value.name.find("Lights.") != std::string::npos; });
}

class ShadowPicture : public testing::Test {
  protected:
    /// The ground seen from straight above: how much of the unshadowed light is left in each pixel; nothing
    /// where there is no light without shadows either. x runs to the right.
    [[nodiscard]] std::vector<std::optional<double>> shares(const std::string& lights,
                                                            const std::string& kind, const glm::dvec3& place,
                                                            const DepthPass& pass,
                                                            const std::vector<Object>& objects) const {
        View view;
        view.camera.position = {0, kHeight, 0};
        view.camera.up = {0, 0, -1};
        view.camera.field_of_view = kFieldOfView;
        view.width = view.height = kSide;
        const auto draw = [&](const std::string& key, bool with_shadows) {
            Drawable lit = drawable("lit", key);
            drop_lights(lit.family);
            add_light(lit.family, lights, place);
            GivenTextures textures;
            std::optional<Result<ShadowMaps>> maps;
            if (with_shadows) {
                maps.emplace(draw_shadow_maps(context_, pass, shadow_lights(lit.family, lit.key), objects,
                                              view.camera.view()));
                textures["shadowMaps"] = (*maps)->texture();
                const auto& values = (*maps)->values();
                lit.family.render.insert(lit.family.render.end(), values.begin(), values.end());
            }
            return render_permutation(context_, lit.stages, lit.interface, objects, lit.family.render, view,
                                      textures)
                .value()
                .color;
        };
        const Image plain = draw(kind + "=1", false);
        const Image shadowed = draw(kind + "=1 " + kind + "_shadows=1", true);
        std::vector<std::optional<double>> result;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double before = plain.at(x, y, 0);
                result.push_back(before > 1e-4 ? std::optional(shadowed.at(x, y, 0) / before) : std::nullopt);
            }
        return result;
    }

    Context context_ = open_context(Backend::osmesa).value();
};

Object ground() {
    return {make_plane(12, 8), glm::dmat4(1), {}, false, true};
}

/// A wall one unit high and two wide without thickness, across the x axis at the origin.
Object wall() {
    const glm::dmat4 upright = glm::rotate(glm::dmat4(1), std::numbers::pi / 2, glm::dvec3(0, 0, 1));
    return {make_plane(2, 1), upright, {}, false, true};
}

/// Along the x axis from the wall on: where the shadow begins and ends, in the scene's unit.
struct Extent {
    double begin = -1;
    double end = -1;
};
Extent shadow_along_x(const std::vector<std::optional<double>>& shares) {
    const double unit = 2 * kHeight * std::tan(kFieldOfView / 2) / kSide;
    Extent extent;
    for (int x = kSide / 2 + 1; x < kSide; ++x) {  // the wall itself, seen from above, is a line
        const std::optional<double>& share = shares[static_cast<std::size_t>(kSide / 2 * kSide + x)];
        if (!share || *share > 0.5) continue;
        const double at = (x - kSide / 2) * unit;
        if (extent.begin < 0) extent.begin = at;
        extent.end = at + unit;
    }
    return extent;
}

/// The share of lit ground that is darkened although nothing stands on it, in per cent.
double acne(const std::vector<std::optional<double>>& shares) {
    double dark = 0;
    double all = 0;
    for (const std::optional<double>& share : shares) {
        if (!share) continue;
        ++all;
        dark += *share < 0.99 ? 1 : 0;
    }
    return 100 * dark / all;
}

struct Light {
    const char* lights;
    const char* kind;
};

class ShadowKind : public ShadowPicture, public testing::WithParamInterface<Light> {};

/// From (-4, 3, 0) a wall one unit high throws a shadow to x = 2 for a local light (similar triangles), and
/// of 4 / 3 for a directional one.
TEST_P(ShadowKind, LiesBehindTheWall) {
    const Light light = GetParam();
    const bool is_local = std::string(light.kind) != "directional";
    const auto found = shares(light.lights, light.kind, {-4, 3, 0}, depth_pass(), {ground(), wall()});
    const Extent extent = shadow_along_x(found);
    EXPECT_LT(extent.begin, 0.06) << "the contact gap";
    EXPECT_NEAR(extent.end, is_local ? 2 : 4.0 / 3, 0.06);
    const double in_front = found[static_cast<std::size_t>(kSide / 2 * kSide + kSide / 4)].value_or(0);
    EXPECT_NEAR(in_front, 1, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Shadows, ShadowKind,
                         testing::Values(Light{"DirectionalLights", "directional"},
                                         Light{"SpotLights", "spot"}, Light{"PointLights", "point"}),
                         [](const auto& light) { return std::string(light.param.kind); });

/// The figures of docs/shadows.md: both faults, for each elevation of a directional light, with no polygon
/// offset, the pass's own, and one much too large.
TEST_F(ShadowPicture, ReportsAcneAndContactGap) {
    const double pixel = 2 * kHeight * std::tan(kFieldOfView / 2) / kSide;
    DepthPass without = depth_pass();
    without.slope = without.units = 0;
    DepthPass too_much = depth_pass();
    too_much.units = 1 << 20;  // of 2^-24: a sixteenth of the depth
    for (const double degrees : {2.0, 15.0, 60.0}) {
        SCOPED_TRACE(degrees);
        const double angle = degrees * std::numbers::pi / 180;
        const glm::dvec3 light(-std::cos(angle), std::sin(angle), 0.01);
        const auto with = [&](const DepthPass& pass, std::vector<Object> objects) {
            return shares("DirectionalLights", "directional", light, pass, objects);
        };
        const double plain = acne(with(without, {ground()}));
        const double own = acne(with(depth_pass(), {ground()}));
        const double gap = shadow_along_x(with(depth_pass(), {ground(), wall()})).begin;
        const double large_gap = shadow_along_x(with(too_much, {ground(), wall()})).begin;
        std::printf("| %.0f | %.1f | %.1f | %.3f | %.3f |\n", degrees, plain, own, gap, large_gap);
        EXPECT_GT(plain, 5) << "without an offset there is acne to be seen";
        EXPECT_LT(own, 0.1);
        EXPECT_LE(gap, 2 * pixel) << "a pixel, and one that the filter softens";
        EXPECT_GT(large_gap, 4 * pixel) << "a gap that is there is seen";
    }
}

}  // namespace
}  // namespace gobo
