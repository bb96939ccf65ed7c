// The directional lights themselves (L3).
//
// Model:  the s and L of each light.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light.
// Space:  eye. Ranges: direction unit or zero, colour 0 to 1e5 (radiance).
// Edges:  a direction of zero is a light from nowhere: it gives nothing (H-L1).

/// `direction` is the unit vector from the surface to the light, in eye space.
struct DirectionalLight {
    vec3 direction;
    vec3 color;
};

BLOCK(4, DirectionalLights) {
    DirectionalLight lights[DIRECTIONAL_LIGHTS];
} directionalLights;
