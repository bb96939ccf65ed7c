// The shadow of a light with six maps, the faces of a cube: a point light's (S15).
//
// Model:  the face is chosen by the largest component of the ray from the light; there the map is a
//         perspective one, whose x, y and depth follow from the ray and three numbers. So a light is one
//         matrix, not six, and its faces are layers of the array that all lights share.
// Source: Gerasimov, Omnidirectional Shadow Mapping, GPU Gems (2004), ch. 12.
// Space:  eye; the faces' axes are those that `toMap` turns to.
// Edges:  at the light itself w is 0: no shadow (H-W1, H-L1). A spread a little below 1/2 draws more than the
//         face, so that the filter's texels lie on it and no seam shows.
#include "shadow/cube_face.glsl"
#include "shadow/shadow.glsl"
#include "shadow/visibility.glsl"
#include "surface/position.glsl"

/// The share of the light that reaches the surface.
float cubeVisibility(Shadow shadow) {
    vec4 ray = cubeFace((shadow.toMap * vec4(surfacePosition(), 1.0)).xyz);
    vec2 place = 0.5 * ray.z + shadow.spread * ray.xy;
    float depth = shadow.depthScale * ray.z + shadow.depthShift;
    return visibility(vec4(place, depth, ray.z), shadow.layer + ray.w);
}
