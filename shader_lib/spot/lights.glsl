// The spot lights themselves (L5).
//
// Model:  the P, L, axis, exponent, cone and attenuation of each light.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual for the inner
//         cone.
// Space:  eye. Ranges: as point lights; versines 0 to 2 (1 - cos of the half angle), exponent 0 to 1e6, axis
//         unit.
// Edges:  spot/cone.glsl tells what equal and extreme angles mean (H-P1, H-P2).

/// `position` is in eye space, its w is 1 (L6); `axis` is the unit vector along which the light shines. The
/// cone is given by the versines of its half angles, 1 - cos(angle), which hold an angle of 1e-4 as well as
/// one of 90 degrees; `attenuation` holds k_c, k_l, k_q.
struct SpotLight {
    vec4 position;
    vec3 color;
    float exponent;
    vec3 attenuation;
    float innerVersine;
    vec3 axis;
    float outerVersine;
};

BLOCK(6, SpotLights) {
    SpotLight lights[SPOT_LIGHTS];
} spotLights;
