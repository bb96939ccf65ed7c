// Where n.l, the cosine between the normal and the direction to a light, is computed.

#piece fragment
// Where the model is evaluated.
/// Prepares the cosines of all lights: nothing.
void beginCosines() {}

/// The cosine between the normal and the direction to the next light.
float nextCosine(vec3 normal, vec3 toLight) { return dot(normal, toLight); }

#piece vertex.frag
// At the vertices, and interpolated, so that only the tone is found per fragment. Cheaper, with visible artefacts: between
// two normals that are an angle a apart a cosine is as small as cos(a / 2), and bands have corners at the mesh's edges.
// Source: Lighthouse3D, GLSL Tutorial, Toon Shader, version I.
#include <sides/cosine>

/// The number of the next light.
int nextLightNumber;

/// Prepares the cosines of all lights. To be called before the first light.
void beginCosines() { nextLightNumber = 0; }

/// The cosine between the normal and the direction to the next light.
float nextCosine(vec3 normal, vec3 toLight) {
    int number = nextLightNumber++;
    return cosineOfSide(lightCosines[number / 4][number % 4]);
}
