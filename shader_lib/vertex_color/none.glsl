// The surface has the colours of its material alone.

/// The reflectivity that scatters light.
vec3 tinted(vec3 reflectivity) { return reflectivity; }
