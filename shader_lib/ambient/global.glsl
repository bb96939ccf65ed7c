// Light that comes from everywhere alike (L2).
//
// Model:  A constant.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Ambient Light.
// Range:  A 0 to 1e5 (radiance).
// Edges:  none: the light is the same wherever the surface lies and faces.

/// The global ambient light A.
BLOCK(2, Ambient) {
    vec3 color;
} ambient;

/// The ambient light that arrives at the surface.
vec3 ambientLight() { return ambient.color; }
