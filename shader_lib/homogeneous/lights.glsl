// The homogeneous lights themselves (L6).
//
// Model:  the P (or direction), L, k_c, k_l and k_q of each light.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: one vec4 for positions and directions, w = 0 for these.
// Space:  eye. Ranges: components within 1e6, colour 0 to 1e5 (radiance at attenuation 1).
// Edges:  a vector of zero is a light from nowhere (H-L1).

/// `position` is a point in eye space, times its w; or where w is 0 the direction to the light, of any length.
/// `attenuation` holds k_c, k_l, k_q, which a direction does not need.
struct HomogeneousLight {
    vec4 position;
    vec3 color;
    vec3 attenuation;
};

BLOCK(11, HomogeneousLights) {
    HomogeneousLight lights[HOMOGENEOUS_LIGHTS];
} homogeneousLights;
