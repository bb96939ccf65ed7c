// The angle between a unit normal and the half vector of two unit directions, as a versine (S3).
//
// Model, source, range, edges: versineToHalfway().
#include "angle/halfway.glsl"

/// 1 - cos of the angle between `normal` and the half vector of the directions to the light and the viewer.
float halfwayVersine(vec3 normal, vec3 toLight, vec3 toViewer) {
    return versineToHalfway(normal, toLight, toViewer);
}
