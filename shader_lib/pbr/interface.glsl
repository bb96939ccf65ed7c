// What becomes of light at the surface: a part is mirrored, the rest enters and may be scattered.
//
// Source: glTF 2.0, appendix B.3.4.

/// The part of the light that is mirrored, by channel: all of what Fresnel's law says, `bare`. Besides, the cosine that this holds at, and
/// what a surface that mirrors everything would mirror.
vec3 mirroredPart(vec3 bare, float cosine, float whole) { return bare; }

/// The part that enters.
vec3 enteringPart(vec3 mirrored) { return max(1.0 - mirrored, 0.0); }  // guard: colours of vertices rounded above 1
