// Where the object stands and how it is projected (E2, E4).
//
// Model:  M, P and N.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Per-vertex Diffuse Shading.
// Space:  object, eye and clip.
// Range:  entries within 1e6.
// Edges:  normalMatrix is the inverse transpose of modelView's upper left 3x3, or any positive multiple of it
//         (the cofactors where the model is singular, H-G1): lengths do not matter.

/// The object's transformations: to eye space, from eye space to clip space, and of normals to eye space.
BLOCK(0, Transform) {
    mat4 modelView;
    mat4 projection;
    mat3 normalMatrix;
} transform;
