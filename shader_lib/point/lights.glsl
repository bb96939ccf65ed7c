// The point lights themselves (L4).
//
// Model:  the P, L, k_c, k_l and k_q of each light.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.
// Space:  eye. Ranges: positions within 1e6, colour 0 to 1e5 (radiance at attenuation 1).
// Edges:  attenuation() tells what coefficients of zero mean (H-L2).

/// `position` is in eye space, its w is 1 (L6); `attenuation` holds k_c, k_l, k_q.
struct PointLight {
    vec4 position;
    vec3 color;
    vec3 attenuation;
};

BLOCK(5, PointLights) {
    PointLight lights[POINT_LIGHTS];
} pointLights;
