// What the fogs are described by (F1, F2, F3); each reads what it needs.
//
// Model:  the C, d, n and f of the fogs.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Ranges: colour 0 to 1e5 (radiance), density 0 to 1e3, distances near and far 0 to 1e6.
// Edges:  the fogs themselves tell what a density of 0 and near = far mean (H-F1).

/// The fog's colour; the density of exponential fog; where linear fog begins and where it hides everything.
BLOCK(3, Fog) {
    vec3 color;
    float density;
    float near;
    float far;
} fog;
