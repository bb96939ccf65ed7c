// One material for the whole draw (S9).
//
// Model:  emission, K_a, K_d, K_s, m, and the strength of the highlight.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Material Properties.
// Ranges: reflectivities 0 to 1, emission 0 to 1e5 (radiance), shininess 0 to 1e6, strength 0 to 1e3.
// Edges:  none: a material of zeros reflects nothing.

/// What the surface emits and how much it reflects, per colour channel. `strength` scales the highlight (S5).
BLOCK(1, Material) {
    vec3 emission;
    float shininess;
    vec3 ambient;
    float strength;
    vec3 diffuse;
    vec3 specular;
} material;

/// Makes `material` that of the surface point: it always is. To be called first.
void chooseMaterial() {}
