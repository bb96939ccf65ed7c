// The surface's position in the fragment stage: interpolated in eye space (E4).

/// The position of the surface in eye space.
vec3 surfacePosition() { return eyePosition; }
