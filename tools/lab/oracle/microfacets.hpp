// The terms of physically based reflection in double precision, written from their equations: what a
// metallic-roughness surface of the family `pbr` sends to the viewer.
//
// Sources: glTF 2.0, appendix B, and its extensions; Walter et al. 2007; Heitz 2014; each function names its
// own.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "lab/oracle/environment.hpp"
#include "lab/oracle/lights.hpp"

namespace gobo::oracle {

/// What roundings on the way do to a result: each quantity that a float evaluation holds is moved by up to
/// `step` of its size, at random. Without a step everything is exact. (Vignes, A stochastic arithmetic for
/// reliable scientific computation, Mathematics and Computers in Simulation 35, 1993.)
class Roundings {
  public:
    Roundings() = default;
    Roundings(double step, std::uint64_t seed) : step_(step), state_(seed) {}

    /// The quantity, off by a rounding of its own size, or of the terms that it is the sum of.
    [[nodiscard]] double operator()(double value) { return value + step_ * value * next(); }
    [[nodiscard]] double operator()(double value, double size) { return value + step_ * size * next(); }
    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& value, double size);

  private:
    /// From -1 to 1.
    double next();

    double step_ = 0;
    std::uint64_t state_ = 0;
};

/// The width of the slopes' distribution: roughness squared, at least 0.002.
[[nodiscard]] double alpha_of_roughness(double roughness);

/// What a pixel shows of it where normals turn within the pixel (Tokuyoshi and Kaplanyan 2019).
[[nodiscard]] double widened_alpha(const Model& model, double alpha, double bend);

/// Trowbridge and Reitz' distribution of normals at the half vector of two directions (glTF 2.0, B.3.2). With
/// normals that are shorter than 1 the sine is what the key's formula makes of them.
[[nodiscard]] double normal_distribution(Distribution kind, double alpha, const glm::dvec3& normal,
                                         const glm::dvec3& to_light, const glm::dvec3& to_viewer,
                                         Roundings& roundings);

/// G / (4 n.l n.v); `half_square` is |l + v|^2:
/// - correlated: Smith's, by Heitz 2014, equation 99;
/// - interpolated: Hammon's 1 / (2 mix(2 n.l n.v, n.l + n.v, alpha));
/// - half_angle: 1 / |l + v|^2, as Kelemen's 1 / (4 (l.h)^2).
[[nodiscard]] double visibility_term(MaskingShadowing kind, double alpha, double nl, double nv,
                                     double half_square, Roundings& roundings);

/// What reflects at the cosine `vh` of half the angle between light and viewer.
struct Reflectance {
    glm::dvec3 base{0};        ///< base colour: a metal's F0
    glm::dvec3 dielectric{0};  ///< F0 of what is not metal
    double dielectric_edge = 1;
    double metallic = 0;

    [[nodiscard]] glm::dvec3 f0() const;
    [[nodiscard]] double f90() const;
};

/// - exact: a dielectric by Fresnel's equations, metals by Schlick's;
/// - schlick: F0 + (F90 - F0) (1 - vh)^5;
/// - gaussian: with 2^((-5.55473 vh - 6.98316) vh) for the power (Lagarde 2012);
/// - constant: F0.
[[nodiscard]] glm::dvec3 fresnel_reflectance(Fresnel kind, const Reflectance& surface, double vh);

/// Light scattered per solid angle by a surface of that diffuse colour: Lambert's, Burley's (2012), or the
/// energy-preserving Oren and Nayar of Portsmouth, Kutz and Hill (2025).
[[nodiscard]] glm::dvec3 diffuse_lobe(DiffuseLobe kind, const glm::dvec3& color, double roughness, double nl,
                                      double nv, double lv, double vh);

/// A and B of A F0 + B F90. `table` is what the table holds there.
[[nodiscard]] glm::dvec2 environment_brdf(EnvironmentBrdf kind, const glm::dvec2& table, double nv,
                                          double roughness);

/// Charlie's sheen (Estevez, Kulla 2017): L, what Smith's term of a direction at that cosine amounts to, and
/// the albedo of a white sheen in even light at that cosine, as fitted.
[[nodiscard]] double sheen_shadow(double alpha, double cosine, Roundings& roundings);
[[nodiscard]] double sheen_albedo(double alpha, double cosine, Roundings& roundings);

/// A surface point and all that reaches it.
struct PhysicalPoint {
    glm::dvec3 normal{0};       ///< unit, unless it is interpolated as it is
    glm::dvec3 coat_normal{0};  ///< of the mesh, whatever a picture makes of it
    glm::dvec3 to_viewer{0};    ///< unit, or zero
    glm::dvec4 tangent{0};      ///< as it is given, and the bitangent's sign
    double normal_length = 1;   ///< of the normal of a picture before it is made unit
    double bend = 0;            ///< |dn/dx|^2 + |dn/dy|^2 of the mesh's normals, from pixel to pixel
    glm::dvec4 base_color{0};
    double metallic = 0;
    double roughness = 0;
    double occlusion = 1;  ///< what ambient light is multiplied by
    glm::dvec3 emission{0};
    std::vector<IncidentLight> lights;
    std::vector<bool> has_half;  ///< per light, whether it and the viewer have a half vector
    AmbientLight ambient;
    LookedUp reflected;       ///< what the environment shows in the mirrored direction
    LookedUp coat_reflected;  ///< and in that of the coat
};

/// The radiance that leaves the point towards the viewer, before fog, and at least the sum of its absolute
/// terms with every cosine taken as at least 0.01.
struct PhysicalRadiance {
    glm::dvec3 value{0};
    glm::dvec3 largest{0};
    /// What a surface of the same roughness would send that scatters and mirrors all light, each light's
    /// scattered before its cosine weakens it: what approximations err by is a part of that.
    glm::dvec3 of_white{0};
};

/// emission + w E S + (1 - w E) c_d A + sum (f_d + f_s) n.l L (glTF 2.0, appendix B).
[[nodiscard]] PhysicalRadiance radiance_of(const Model& model, const Scene& scene, const PhysicalPoint& point,
                                           Roundings& roundings);

}  // namespace gobo::oracle
