// What the lighting models of the family `lit` are asked about: one surface point and all that lights it, by
// meaning. Points and directions are in eye space, where the viewer stands at the origin and looks along -z.
#pragma once

#include <array>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gobo::oracle {

/// How a surface's values change from a pixel to its neighbour in one direction of the picture.
struct PixelStep {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};
    glm::dvec2 texture_coordinate{0};
    glm::dvec2 texture_coordinate1{0};
};

/// A point of a surface.
struct SurfacePoint {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};               ///< of any length; zero where there is none
    glm::dvec4 color{1};                ///< of the vertices, and their alpha
    double opacity = 1;                 ///< the alpha of the opacity map there
    int material = 0;                   ///< index into the table of materials, or of its pairs
    bool is_back = false;               ///< which side is seen
    glm::dvec2 texture_coordinate{0};   ///< of the first set
    glm::dvec2 texture_coordinate1{0};  ///< of the second
    glm::dvec4 tangent{0};              ///< and in w the sign of the bitangent
    PixelStep along_x = {};             ///< to the right
    PixelStep along_y = {};             ///< upwards

    /// Per light, where its cosine to the front's normal is found at the vertices and interpolated.
    std::vector<double> cosines = {};

    // What hybrid shading is given besides, interpolated between vertices.
    std::vector<glm::dvec4> rays = {};      ///< per local light: its direction, and the weight that arrives
    std::vector<glm::dvec3> halfways = {};  ///< per light: between its direction and the viewer's
};

/// Reflectivities per colour channel, 0 to 1; emission in radiance.
struct Material {
    glm::dvec3 emission{0};
    glm::dvec3 ambient{0};
    glm::dvec3 diffuse{0};
    glm::dvec3 specular{0};
    double shininess = 0;
    double strength = 1;  ///< scales the highlight

    // Of a metallic-roughness surface, all 0 to 1, as glTF has them.
    glm::dvec4 base_color{1};
    double metallic = 1;
    double roughness = 1;
    glm::dvec3 dielectric{0.04};  ///< reflectance of what is not metal, at normal incidence
    double dielectric_edge = 1;   ///< and at grazing incidence
    glm::dvec3 sheen_color{0};
    double sheen_roughness = 0;
    glm::dvec2 anisotropy_direction{1, 0};  ///< unit, by tangent and bitangent
    double anisotropy = 0;
    double clearcoat = 0;
    double clearcoat_roughness = 0;
    double normal_scale = 1;
    double occlusion_strength = 1;
};

/// A picture whose colour changes evenly: at (s, t) it is `even` + s `along_s` + t `along_t`.
struct EvenPicture {
    glm::dvec4 even{1};
    glm::dvec4 along_s{0};
    glm::dvec4 along_t{0};

    [[nodiscard]] glm::dvec4 at(const glm::dvec2& place) const {
        return even + place.x * along_s + place.y * along_t;
    }
};

/// Where a picture lies on the surface: `linear` (a, b, c, d) and `offset` make (a u + b v + x, c u + d v +
/// y) of the texture coordinates (u, v) of that set.
struct TexturePlacement {
    glm::dvec4 linear{1, 0, 0, 1};
    glm::dvec2 offset{0};
    int set = 0;
};

/// The pictures of a metallic-roughness surface.
enum class MapKind { base_color, metallic_roughness, normal, occlusion, emissive };
inline constexpr std::size_t kMapKinds = 5;

/// A light so far away that it shines from the same side everywhere.
struct DirectionalLight {
    glm::dvec3 direction{0};  ///< unit, from the surface to the light; zero: no light
    glm::dvec3 color{0};      ///< radiance
};

/// A light that shines from its position to all sides.
struct PointLight {
    glm::dvec3 position{0};
    glm::dvec3 color{0};        ///< radiance where the attenuation is 1
    glm::dvec3 attenuation{0};  ///< k_c, k_l, k_q of 1 / (k_c + k_l d + k_q d^2)
    double nearness = 0;        ///< 1 / range, where the key has ranges; 0: no end
};

/// A point light with a cone. Of its half angles it has 1 - cos.
struct SpotLight : PointLight {
    glm::dvec3 axis{0};  ///< unit, along which the light shines
    double exponent = 0;
    double inner_one_minus_cosine = 0;  ///< full light up to here
    double outer_one_minus_cosine = 2;  ///< none from here on; 2 is all directions
};

/// How a shadowed light's maps are looked up. Of directional and spot lights `to_map` leads from eye space to
/// x, y and depth from 0 to 1, to be divided by w. Of a point light it leads to axes with the light at the
/// origin; on the face of a cube, at w along its axis, the depth is depth_scale + depth_shift / w, and what
/// lies s along a side appears at 1/2 + spread s / w.
struct Shadow {
    glm::dmat4 to_map{1};
    double layer = 0;  ///< of a cube's face +x; -x +y -y +z -z follow
    double depth_scale = 0;
    double depth_shift = 0;
    double spread = 0.5;
};

/// The depth of what is nearest to each light, layer after layer, row after row from y = 0.
struct DepthMaps {
    int width = 1;
    int height = 1;
    int layers = 1;
    std::vector<double> depths = {1};
};

/// A light that is directional or local, as w has it.
struct DirectionalOrPointLight {
    glm::dvec4 position{0};     ///< a direction where w is 0 (below 2^-20), else a point times its w
    glm::dvec3 color{0};        ///< radiance where the attenuation is 1
    glm::dvec3 attenuation{0};  ///< as a point light's; a direction has none
};

/// A sky on one side, a ground on the other.
struct HemisphereLight {
    glm::dvec3 up{0, 1, 0};  ///< unit, eye space; zero: no side
    glm::dvec3 sky{0};       ///< radiance
    glm::dvec3 ground{0};    ///< radiance
};

/// An environment by nine coefficients of spherical harmonics: L00, L1-1, L10, L11, L2-2, L2-1, L20, L21,
/// L22.
struct HarmonicsLight {
    glm::dmat3 to_probe{1};  ///< eye space to the probe's axes
    std::array<glm::dvec3, 9> coefficients{};
    double scale = 1;
};

/// What a cube map holds, as a function of the unit direction d: mean + slope d. Not negative where |slope d|
/// does not exceed the mean.
struct CubeMap {
    glm::dvec3 mean{0};
    glm::dmat3 slope{0};
};

/// A map looked up by a direction of eye space.
struct ImageLight {
    glm::dvec3 color{0};   ///< what the map is mixed with; reflections mix with nothing
    double weight = 0;     ///< the map's, 0 to 1
    glm::dmat3 to_map{1};  ///< rotation from eye space to the map's axes
    CubeMap map;
    double roughest_level = 0;  ///< of a map that is blurred level by level; all levels are alike here
};

/// Distances along the view. Each kind of fog reads what it needs.
struct FogParameters {
    glm::dvec3 color{0};
    double density = 0;
    double start = 0;
    double end = 0;
};

/// All that is the same for every point of a draw.
struct Scene {
    Material material;
    glm::dvec3 ambient{0};
    std::vector<DirectionalLight> directional;
    std::vector<PointLight> point;
    std::vector<SpotLight> spot;
    int toon_levels = 1;
    FogParameters fog;
    double depth_offset = 0;        ///< in window depth
    std::vector<Shadow> shadows{};  ///< of the first directional lights, then spot lights, then point lights
    DepthMaps maps{};
    std::vector<DirectionalOrPointLight> directional_or_point;
    std::vector<glm::dvec3>
        light_ambients;  ///< of each light: directional, point, spot, directional_or_point
    HemisphereLight hemisphere;
    HarmonicsLight harmonics;
    std::array<double, 3> toon_thresholds{0.95, 0.5, 0.25};  ///< cosines, the highest first
    std::array<double, 3> toon_tones{1, 0.6, 0.4};           ///< above each
    std::array<Material, 14> materials;
    double cutout_threshold = 0;  ///< alpha below it is cut
    ImageLight image_light{};
    ImageLight reflection{};
    glm::dvec2 environment_brdf{1, 0};  ///< what a table of it holds
    std::array<EvenPicture, kMapKinds> pictures{};
    std::array<TexturePlacement, kMapKinds> placements{};
    std::vector<double> extension_numbers;  ///< of reflectance_extensions(), all in a row
};

}  // namespace gobo::oracle
