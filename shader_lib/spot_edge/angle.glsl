// Where a ray lies in a spot light's cone, by the angle itself (L5).
//
// Model:  2 sin^2(a / 2) with a = atan(|axis x ray|, axis.ray).
// Source: OpenGL 4 Shading Language Cookbook, ch. 3, Using a Spotlight, which compares acos(axis.ray) with the
//         cutoff; acos has no digits left near 0, the arc tangent of sine and cosine has (Kahan, How Futile are
//         Mindless Assessments of Roundoff in Floating-Point Computation, 2006, 12).
// Space:  any. Range: unit vectors or zero; result 0 to 2.
// Edges:  a zero vector is at a right angle (H-L1); an angle of 1e-4 is good to 0.3 % (H-P4).

/// 1 - cos of the angle between the cone's axis and a ray, both unit (zero: a right angle).
float coneVersine(vec3 axis, vec3 ray) {
    float cosine = dot(axis, ray);
    vec3 normal = cross(axis, ray);
    float sine = sqrt(dot(normal, normal));
    if (sine + abs(cosine) == 0.0) return 1.0;  // H-L1: atan(0, 0) is undefined
    float halfSine = sin(0.5 * atan(sine, cosine));
    return 2.0 * halfSine * halfSine;
}
