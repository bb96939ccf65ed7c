// The lights have no ambient terms: all ambient light is global (L9 is not asked for).

/// Prepares the sum of the lights' ambient terms: there is none.
void beginLightAmbient() {}

/// Adds the ambient term of the next light: none.
void addLightAmbient(float fading) {}

/// The radiance that the surface scatters of all ambient terms.
vec3 lightAmbientRadiance() { return vec3(0.0); }
