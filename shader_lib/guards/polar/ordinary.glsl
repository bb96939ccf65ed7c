// A vector of ordinary length as direction and length, for both at the price of one (L4, L5).
//
// Model:  v = |v| (v / |v|).
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights: length and direction as written there.
// Spaces: any. Range: zero, or lengths from 1e-15 to 1e15; their squares are well within a float.
// Edges:  the zero vector has direction zero and length 0 (H-L1); outside the range as unitVector().

/// The unit vector along v in xyz (zero where v is zero), the length of v in w.
vec4 directionAndLength(vec3 v) {
    float square = dot(v, v);
    return vec4(v * inversesqrt(max(square, 1e-30)), sqrt(square));  // H-L1: 0 stays 0
}
