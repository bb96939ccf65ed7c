// The radiance of a face of which one vertex is shaded on one side.

/// The radiance of the face's provoking vertex.
vec3 faceRadiance() { return flatRadiance; }
