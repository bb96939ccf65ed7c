// Each light brings ambient light of its own, where a switch has it so.

#piece switched
#include "light_ambient/sum.glsl"
#include "uber/light_ambient.glsl"
#include "uber/switches.glsl"

/// Prepares the sum of the lights' ambient terms. To be called before the first light.
void beginLightAmbient() { ambientOfLights = emptySum(); }

/// Adds the ambient term of the light that is being added, weakened by its distance.
void addLightAmbient(float byDistance) {
    if (switches.light_ambient == 1) addTerm(ambientOfLights, byDistance * ambientOfLight);
}
