// The cone of a spot light (L5): how much of it reaches a direction, by the angle to the cone's axis.
//
// Model:  e(u) c^exponent with u = 1 - c, c the cosine of the angle, and the edge e: 1 up to the inner angle,
//         0 from the outer angle on, between them ((u_outer - u) / (u_outer - u_inner))^2.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights; glTF 2.0 KHR_lights_punctual for the edge.
// Space:  any. Ranges: versines 0 to 2 (1 - cos of the half angle), exponent 0 to 1e6; result 0 to 1.
// Edges:  outer angle 0 is nothing, 90 degrees the half space, 180 degrees everything (H-P2); inner = outer
//         is a hard edge (H-P1); the edge is true to 0.3 % of the angle down to 1e-4 radians (H-P4).
#include <spot_edge>
#include "power/exact.glsl"

/// The edge at a versine: its order of questions leaves the division only where inner < outer.
float coneEdge(float versine, float innerVersine, float outerVersine) {
    if (versine >= outerVersine) return 0.0;
    if (versine <= innerVersine) return 1.0;  // H-P1
    float fade = (outerVersine - versine) / (outerVersine - innerVersine);
    return fade * fade;
}

/// The share of the light on the unit vector `ray`, which leads away from the light.
float coneFactor(vec3 axis, vec3 ray, float innerVersine, float outerVersine, float exponent) {
    float versine = min(coneVersine(axis, ray), 1.9999998);  // H-P2: 180 degrees holds all directions
    return coneEdge(versine, innerVersine, outerVersine) * cosinePower(versine, exponent);
}
