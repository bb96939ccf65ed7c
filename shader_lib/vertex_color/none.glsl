// The surface has the colours of its material alone (S17 is not asked for).

/// The reflectivity that scatters light.
vec3 tinted(vec3 reflectivity) { return reflectivity; }
