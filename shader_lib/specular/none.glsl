// No highlights: the surface is dull (S2 and S3 are not asked for).

/// Prepares what all highlights share: nothing.
void beginHighlights() {}

/// Adds a light's highlight: none.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {}

/// The radiance of all highlights.
vec3 highlightRadiance() { return vec3(0.0); }
