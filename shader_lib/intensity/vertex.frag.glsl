// How steeply light falls on the surface, computed at the vertices and interpolated, so that only the tone is found per
// fragment (S8). Cheaper, and known to look bad: between two normals that are an angle a apart a cosine is as small as
// cos(a / 2), and bands have corners at the mesh's edges.
//
// Model:  n.s at each vertex.
// Source: Lighthouse3D, GLSL Tutorial, Toon Shader, version I.
// Range:  -1 to 1.
// Edges:  interpolation may leave the range by a rounding, which the tones allow for (H-T1, H-I1). A light at the
//         surface's own position falls on it as on the vertices around (H-L1).
#include <sides/cosine>

/// The number of the next light.
int nextLightNumber;

/// Prepares the cosines of all lights. To be called before the first light.
void beginIntensities() { nextLightNumber = 0; }

/// The cosine between the normal and the direction to the next light.
float nextIntensity(vec3 normal, vec3 toLight) {
    int number = nextLightNumber++;
    return cosineOfSide(lightIntensities[number / 4][number % 4]);
}
