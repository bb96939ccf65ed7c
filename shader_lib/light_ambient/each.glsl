// Each light brings ambient light of its own, numbered as the lights are (L9).
//
// Model, source, ranges, edges: the sum's.
#include "light_ambient/sum.glsl"

/// A_l of each light: first the directional ones, then point, spot and homogeneous lights.
BLOCK(13, LightAmbients) {
    vec3 colors[DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS + HOMOGENEOUS_LIGHTS];
} lightAmbients;

/// The number of the next light.
int nextLight;

/// Prepares the sum of the lights' ambient terms. To be called before the first light.
void beginLightAmbient() {
    ambientOfLights = emptySum();
    nextLight = 0;
}

/// Adds the ambient term of the next light, weakened by `fading`.
void addLightAmbient(float fading) {
    addTerm(ambientOfLights, fading * lightAmbients.colors[nextLight]);
    ++nextLight;
}
