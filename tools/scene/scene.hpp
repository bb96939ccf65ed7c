// The data model of a scene: what read_scene() makes of a glTF file. World space is glTF's: right-handed, y
// up, lengths in the scene's unit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/diagnostic.hpp"
#include "scene/picture.hpp"

namespace gobo::scene {

/// All points between two corners, both included, in double precision. Empty until a point is added.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool is_empty() const { return !(low.x <= high.x); }
    void add(const glm::dvec3& point) { add(Box{point, point}); }
    void add(const Box& other);
    /// Corner 0 to 7.
    [[nodiscard]] glm::dvec3 corner(int index) const;
};

/// Fog as `extras.gobo.fog` states it. Distances in the scene's unit, the colour is a radiance.
struct Fog {
    std::string kind;  ///< "none", "linear", "exponential" or "exponential_squared"
    glm::dvec3 color{0};
    double density = 0;
    double near = 0;
    double far = 0;
};

/// Light from all around, as `extras.gobo.probe` states it, in the axes of world space.
struct Probe {
    std::string
        kind;  ///< "none", or a value of lit's `ambient`: "hemisphere", "spherical_harmonics", "image"
    glm::dvec3 up{0, 1, 0};  ///< of a hemisphere: a unit vector towards its sky
    glm::dvec3 sky{0};       ///< radiances
    glm::dvec3 ground{0};
    std::array<glm::dvec3, 9> coefficients{};  ///< L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22
    double scale = 0;                          ///< of their irradiance
    double share = 1;                          ///< of an image, against the scene's ambient light
};

/// What `extras.gobo` of a scene, node or material asks for; nothing where it says nothing. A material
/// overrides its node, a node those above it, and these the scene.
struct Overrides {
    std::optional<Fog> fog;
    std::optional<int> toon_levels;       ///< 0: no toon shading
    std::optional<std::string> specular;  ///< "phong" or "blinn"; "none": no highlights
    std::optional<Probe> probe;
    std::optional<double> reflection;  ///< the share of an environment's image that it mirrors; 0: none
    std::optional<bool> shadow;        ///< receives shadows
    std::map<std::string, std::string> quality;  ///< values of features of quality: "shading", "vertex"

    /// Takes over what is not said yet from `outer`.
    void fill_from(const Overrides& outer);
};

enum class AlphaMode { opaque, mask, blend };

/// The alpha of a picture, row after row from the top (where texture coordinates are 0); empty: not known.
struct AlphaMap {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;
};

/// The pictures of a metallic-roughness material, in the order in which shaders number them.
inline constexpr std::array kMapFeatures = {"base_color_map", "metallic_roughness_map", "normal_map",
                                            "occlusion_map", "emissive_map"};
enum class MapKind { base_color, metallic_roughness, normal, occlusion, emissive };

/// A texture as a material uses it: (a u + b v + x, c u + d v + y) of the texture coordinates (u, v) of
/// `set`, where `linear` is (a, b, c, d) and `offset` (x, y).
struct TextureUse {
    std::size_t picture = 0;  ///< of the scene
    std::int64_t set = 0;
    glm::dvec4 linear{1, 0, 0, 1};
    glm::dvec2 offset{0};
    int wrap_s = 10497;  ///< OpenGL's numbers
    int wrap_t = 10497;
    bool is_nearest = false;  ///< magnified without interpolation
    int min_filter = 9987;    ///< OpenGL's number; where the file states none, GL_LINEAR_MIPMAP_LINEAR

    /// Where the picture is looked up.
    [[nodiscard]] glm::dvec2 placed(const glm::dvec2& place) const {
        return {linear[0] * place.x + linear[1] * place.y + offset.x,
                linear[2] * place.x + linear[3] * place.y + offset.y};
    }
    [[nodiscard]] bool is_placed() const {
        return set != 0 || linear != glm::dvec4(1, 0, 0, 1) || offset != glm::dvec2(0);
    }
};

/// A material in the terms of glTF and of the family `pbr`: as Material of templates/pbr.toml. Emission is
/// the material's own.
struct PhysicalMaterial {
    glm::dvec4 base_color{1};
    double metallic = 1;
    double roughness = 1;
    glm::dvec3 dielectric{0.04};
    double dielectric_edge = 1;
    double normal_scale = 1;
    double occlusion_strength = 1;
    std::array<std::optional<TextureUse>, kMapFeatures.size()> maps;
    /// What its extensions state, by uniform (material_extensions.hpp).
    std::map<std::string, std::vector<double>> of_extensions;
    std::vector<std::string> not_drawn;  ///< extensions and their pictures that no family has
};

/// A material in the terms of the family `lit`. docs/scene_format.md states how it follows from glTF's.
struct Material {
    std::string name;
    glm::dvec3 emission{0};
    glm::dvec3 ambient{0};
    glm::dvec3 diffuse{0};
    glm::dvec3 specular{0};  ///< zero: no highlight
    double strength = 1;
    double shininess = 0;
    bool unlit = false;
    bool is_textured = false;
    bool is_metal = false;  ///< its file states a metallicFactor above 0, and no model of `lit`
    bool double_sided = false;
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;
    double alpha = 1;  ///< of the base colour
    std::optional<AlphaMap>
        opacity;  ///< of the base colour's picture where alpha_mode is mask and it has any
    Overrides overrides;
    PhysicalMaterial physical;  ///< where the scene is read for a family of such materials
};

enum class LightKind { directional, point, spot };
/// In its order: as glTF names them, and the features that count them.
inline constexpr std::array kLightKinds = {"directional", "point", "spot"};

/// A light of KHR_lights_punctual. It shines along -z of its node.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::dvec3 color{1};  ///< colour times intensity: the radiance at attenuation 1
    double range = std::numeric_limits<double>::infinity();
    glm::dvec3 attenuation{0, 0, 1};  ///< k_c, k_l, k_q
    double inner_angle = 0;           ///< half angles of the cone, radians, at most pi / 2
    double outer_angle = 0;
    double exponent = 0;
    bool casts_shadow = false;
};

/// A camera looks along -z of its node.
struct Camera {
    std::string name;
    bool is_perspective = true;
    double vertical_angle = 0;  ///< perspective: of the whole view, radians
    std::optional<double> aspect;
    glm::dvec2 half_extent{0};  ///< orthographic
    double near_plane = 0;
    double far_plane = std::numeric_limits<double>::infinity();
};

enum class Topology { points, lines, triangles };

/// A joint of the node's skin that moves a vertex, and how much.
struct Influence {
    std::uint32_t joint = 0;
    float weight = 0;
};

/// One mesh primitive. Strips and fans are triangles already; missing normals have been computed, flat: then
/// no vertex is shared.
struct Primitive {
    Topology topology = Topology::triangles;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;          ///< one per position
    std::vector<glm::vec2> texcoords;        ///< one per position, or none
    std::vector<glm::vec4> colors;           ///< one per position, or none; RGBA
    std::vector<glm::vec2> texcoords1 = {};  ///< the second set: one per position, or none
    std::vector<glm::vec4> tangents = {};    ///< one per position, or none; the bitangent's sign in w
    std::vector<std::uint32_t> indices;      ///< three per triangle
    std::vector<std::vector<glm::vec3>> target_positions;  ///< per morph target, one per position
    std::vector<std::vector<glm::vec3>> target_normals;    ///< per morph target, one per position, or none
    std::set<std::string> targets_not_read = {};     ///< attributes of morph targets that are not morphed
    std::vector<std::vector<Influence>> influences;  ///< one list per position, or none
    std::size_t material = 0;                        ///< the last of the scene is glTF's default material
    bool has_flat_normals = false;                   ///< they were computed
};

/// The unit normals of triangles that share no vertex, three positions each; zero where one has no area.
[[nodiscard]] std::vector<glm::vec3> flat_normals(const std::vector<glm::vec3>& positions);

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<double> weights;  ///< of its morph targets, at rest
};

struct Interval {
    double low = 0;
    double high = 0;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Everything that animations do to a node: it stays within these, between keyframes too.
struct Motion {
    Box translation;
    Box scale;
    bool rotates = false;
    bool moves = false;             ///< translation, scale or rotation is animated
    std::vector<Interval> weights;  ///< of morph targets; empty: not animated
};

struct Node {
    std::string name;
    std::optional<std::size_t> parent;
    std::vector<std::size_t> children;
    std::optional<std::size_t> mesh;
    std::optional<std::size_t> skin;
    std::optional<std::size_t> camera;
    std::optional<std::size_t> light;
    std::vector<double> weights;  ///< of its mesh's morph targets; empty: the mesh's
    /// Where EXT_mesh_gpu_instancing puts its mesh, each in the node's space; empty: once, where the node is.
    std::vector<glm::dmat4> instances;
    bool has_matrix = false;
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 scale{1};
    glm::dmat4 local{1};  ///< to the parent's space, at rest
    glm::dmat4 world{1};  ///< to world space, at rest
    bool in_scene = false;
    bool is_visible = true;  ///< KHR_node_visibility: what hangs below a hidden node is hidden
    std::optional<Motion> motion;
    Overrides overrides;
};

struct Skin {
    std::vector<std::size_t> joints;       ///< nodes
    std::vector<glm::dmat4> inverse_bind;  ///< one per joint
};

/// A scene with everything that decides which effects its draws need, and what a renderer needs to draw it.
struct Scene {
    std::string path;
    std::vector<std::string> files;     ///< every file read, the scene first
    std::vector<std::string> not_read;  ///< extensions that it uses, and that gobo does not know
    Diagnostics warnings;               ///< of what the specification forbids and can still be drawn
    std::vector<Node> nodes;
    std::vector<std::size_t> order;  ///< the nodes of the scene, parents before children
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    bool is_physical = false;            ///< read for a family of metallic-roughness materials
    bool has_no_light = false;           ///< where `pbr` reads it, an environment stands in
    std::vector<TextureImage> pictures;  ///< that such materials use
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Skin> skins;
    glm::dvec3 ambient{0};                 ///< radiance from everywhere
    std::optional<glm::dvec3> background;  ///< radiance behind everything
    Overrides overrides;
};

/// Of the morph targets of the node's mesh: the node's own, else the mesh's.
[[nodiscard]] inline const std::vector<double>& weights_at_rest(const Scene& scene, const Node& node) {
    return node.weights.empty() ? scene.meshes[*node.mesh].weights : node.weights;
}

}  // namespace gobo::scene
