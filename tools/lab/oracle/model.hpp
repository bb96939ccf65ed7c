// Which of the lighting models a key of the families `lit` and `pbr` stands for.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "family/family.hpp"

namespace gobo::oracle {

enum class Diffuse { lambert, toon, toon_ceil, toon_thresholds };
enum class Specular { none, phong, blinn };
enum class Fog { none, linear, exponential, exponential_squared };
enum class FogDistance { radial, planar };
enum class Shading { fragment, hybrid, vertex, flat };
enum class Reflection { none, image };
enum class ShadowFilter { bilinear, sampler, nearest };
enum class OutputRange { unbounded, half_float, display };
enum class Depth { untouched, any, greater, less, unchanged };
enum class Lighting { lit, unlit, metallic_roughness, base_color };
enum class LightAmbient { none, each };
enum class Ambient { global, hemisphere, spherical_harmonics, image };
enum class Hemisphere { sine, cosine };
enum class Harmonics { second, first, zeroth };
enum class MaterialChoice { uniform, array };
enum class Sides { one, two, two_materials };
enum class Cutout { none, threshold };
enum class VertexColor { none, modulate };

// Quality: the same model where it is evaluated, or what stands in for parts of it.
enum class NDotL { fragment, vertex };
enum class Normal { renormalised, interpolated };
enum class Viewer { local, infinite };
enum class Power { exact, near_exact, squaring, gaussian_fitted, gaussian, lyon, schlick };
enum class LightSum { plain, compensated, pairwise };
enum class Guards { full, ordinary };
enum class SpotEdge { one_minus_cosine, angle, cosine };

// Of physically based surfaces.
enum class Distribution { cross_product, plain };
enum class MaskingShadowing { correlated, interpolated, half_angle };
enum class Fresnel { exact, schlick, gaussian, constant };
enum class DiffuseLobe { oren_nayar, burley, lambert };
enum class EnvironmentBrdf { table, karis, lazarov, constant };
enum class MultipleScattering { returned, none };
enum class Picture { none, texture };
enum class NormalMap { none, tangent, derivatives };
enum class SpecularAntialiasing { none, widened };
enum class Placement { plain, placed };
enum class Clearcoat { none, layer };
enum class Sheen { none, charlie };
enum class LightRange { unlimited, windowed };
enum class Anisotropy { none, brushed };

/// One model: everything about a key that the radiance and the depth depend on.
struct Model {
    int directional = 0;
    int point = 0;
    int spot = 0;
    Diffuse diffuse = Diffuse::lambert;
    Specular specular = Specular::none;
    Fog fog = Fog::none;
    FogDistance fog_distance = FogDistance::radial;
    Shading shading = Shading::fragment;
    Depth depth = Depth::untouched;
    NDotL n_dot_l = NDotL::fragment;  ///< where the cosine of each light is found
    Normal normal = Normal::renormalised;
    Viewer viewer = Viewer::local;
    Power power = Power::exact;
    LightSum light_sum = LightSum::plain;
    Guards guards = Guards::full;
    SpotEdge spot_edge = SpotEdge::one_minus_cosine;
    int directional_shadows = 0;  ///< the first so many lights of each kind
    int point_shadows = 0;
    int spot_shadows = 0;
    Reflection reflection = Reflection::none;
    ShadowFilter shadow_filter = ShadowFilter::bilinear;
    Lighting lighting = Lighting::lit;
    int directional_or_point = 0;
    LightAmbient light_ambient = LightAmbient::none;
    Ambient ambient = Ambient::global;
    Hemisphere hemisphere = Hemisphere::sine;
    Harmonics harmonics = Harmonics::second;
    MaterialChoice material = MaterialChoice::uniform;
    Sides sides = Sides::one;
    Cutout cutout = Cutout::none;
    VertexColor vertex_color = VertexColor::none;
    OutputRange output_range = OutputRange::unbounded;

    Distribution distribution = Distribution::cross_product;
    MaskingShadowing masking_shadowing = MaskingShadowing::correlated;
    Fresnel fresnel = Fresnel::schlick;
    DiffuseLobe diffuse_lobe = DiffuseLobe::lambert;
    EnvironmentBrdf environment_brdf = EnvironmentBrdf::karis;
    MultipleScattering multiple_scattering = MultipleScattering::none;
    Picture base_color_map = Picture::none;
    Picture metallic_roughness_map = Picture::none;
    NormalMap normal_map = NormalMap::none;
    Picture occlusion_map = Picture::none;
    Picture emissive_map = Picture::none;
    Placement texture_placement = Placement::plain;
    Clearcoat clearcoat = Clearcoat::none;
    Sheen sheen = Sheen::none;
    SpecularAntialiasing specular_antialiasing = SpecularAntialiasing::none;
    LightRange light_range = LightRange::unlimited;
    Anisotropy anisotropy = Anisotropy::none;
    std::vector<std::size_t> extensions{};  ///< by their places among reflectance_extensions()

    /// Whether it is of the family `pbr`.
    [[nodiscard]] bool is_physical() const {
        return lighting == Lighting::metallic_roughness || lighting == Lighting::base_color;
    }

    /// A formula kept to show what its guard is for, whose loss of digits docs/pbr.md states.
    [[nodiscard]] bool is_known_to_cancel() const { return distribution == Distribution::plain; }

    /// Whether a point hangs on its neighbours in the picture.
    [[nodiscard]] bool takes_derivatives() const {
        return normal_map == NormalMap::derivatives || specular_antialiasing == SpecularAntialiasing::widened;
    }

    /// Whether normals are given per fragment, interpolated.
    [[nodiscard]] bool is_per_fragment() const {
        return shading == Shading::fragment || shading == Shading::hybrid;
    }
    [[nodiscard]] int lights() const { return directional + point + spot + directional_or_point; }
    [[nodiscard]] bool looks_up_images() const {
        return ambient == Ambient::image || reflection == Reflection::image;
    }
    [[nodiscard]] int shadows() const { return directional_shadows + point_shadows + spot_shadows; }
};

/// The model of a key of `lit` or `pbr`; otherwise the reason why the oracle has none: another family, or a
/// feature or value that stands at anything but its default and that the oracle's equations do not cover.
[[nodiscard]] tl::expected<Model, std::string> model_of(const Family& family, const Key& key);

}  // namespace gobo::oracle
