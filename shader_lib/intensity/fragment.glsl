// How steeply light falls on the surface, computed where the model is evaluated (S1, S7, S8).
//
// Model:  n.s.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Diffuse Shading; Lighthouse3D, GLSL Tutorial, Toon
//         Shader, version II.
// Space:  eye. Range: unit vectors or zero; result -1 to 1.
// Edges:  exactly 0 for a zero normal or direction (H-N1, H-L1).

/// Prepares the cosines of all lights: nothing.
void beginIntensities() {}

/// The cosine between the normal and the direction to the next light.
float nextIntensity(vec3 normal, vec3 toLight) { return dot(normal, toLight); }
