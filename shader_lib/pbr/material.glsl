// What the surface is made of, in the terms of glTF's metallic-roughness material. Every permutation takes the whole block, so
// that an application fills it once, whatever a draw makes of it.
//
// Source: glTF 2.0, 3.9 and its extensions KHR_materials_ior, _specular, _clearcoat, _sheen, _anisotropy.
// Ranges: all 0 to 1, but emission 0 to 1e5 (radiance), normalScale within 10.

/// `baseColor` is linear, with alpha. `dielectric` is the reflectance at normal incidence of what is not metal, 0.04 at an index
/// of refraction of 1.5; `dielectricEdge` its reflectance at grazing incidence, 1. `anisotropyDirection` is the unit vector
/// along which the surface is brushed, by tangent and bitangent.
BLOCK(1, Material) {
    vec4 baseColor;
    vec3 emission;
    float metallic;
    vec3 dielectric;
    float roughness;
    vec3 sheenColor;
    float sheenRoughness;
    vec2 anisotropyDirection;
    float anisotropy;
    float dielectricEdge;
    float clearcoat;
    float clearcoatRoughness;
    float normalScale;
    float occlusionStrength;
} material;
