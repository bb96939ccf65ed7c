// What a surface gives back of the light that arrives.
#pragma once

#include "oracle/lights.hpp"
#include "oracle/model.hpp"

namespace gobo::oracle {

/// The scattered share of a light at a cosine to the normal that is not negative: the cosine itself; for toon
/// shading floor(N c) / N, at most (N - 1) / N, or ceil(N c) / N, at most 1; or the tone of the first
/// threshold that the cosine exceeds, else 0.
[[nodiscard]] double diffuse_share(const Model& model, const Scene& scene, double cosine,
                                   Decisions& decisions);

/// The angle whose cosine's power is the highlight: between normal and half vector (Blinn), or between
/// mirrored light and viewer (Phong). `normal` and `to_light` are unit; a zero `to_viewer` is a viewer in no
/// direction.
[[nodiscard]] double highlight_angle(Specular specular, const glm::dvec3& normal, const glm::dvec3& to_light,
                                     const glm::dvec3& to_viewer);

/// max(cos(angle), 0)^shininess, with 0^0 = 1.
[[nodiscard]] double lobe(double angle, double shininess);

/// One light's part of the radiance, with what its accuracy hangs on.
struct LightTerm {
    Arrival arrival;
    double cosine = 0;  ///< between normal and light
    bool is_lit = false;
    double diffuse = 0;          ///< scattered share
    double specular = 0;         ///< reflected share
    double highlight_angle = 0;  ///< as above
    double half_length = 2;      ///< |s + v|: near 0 the half vector is ill-defined
    glm::dvec3 ambient{0};       ///< what the light adds to the ambient light
};

/// What the light does at a surface of this shininess with this unit normal.
[[nodiscard]] LightTerm respond(const Model& model, const Scene& scene, double shininess,
                                const glm::dvec3& normal, const glm::dvec3& to_viewer, const Arrival& arrival,
                                Decisions& decisions);

}  // namespace gobo::oracle
