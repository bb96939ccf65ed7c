// What the fogs are described by; each reads what it needs.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Ranges: colour 0 to 1e5 (radiance), density 0 to 1e3, distances near and far 0 to 1e6.

/// The fog's colour; the density of exponential fog; where linear fog begins and where it hides everything.
BLOCK(3, Fog) {
    vec3 color;
    float density;
    float near;
    float far;
} fog;
