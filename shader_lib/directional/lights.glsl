// The directional lights themselves (L3).
//
// Space:  eye. Ranges: direction unit or zero, colour 0 to 1e5 (radiance).

/// `direction` is the unit vector from the surface to the light, in eye space.
struct DirectionalLight {
    vec3 direction;
    vec3 color;
};

BLOCK(4, DirectionalLights) {
    DirectionalLight lights[DIRECTIONAL_LIGHTS];
} directionalLights;
