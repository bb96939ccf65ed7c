// The angle of Blinn's highlights with hybrid shading (E3, S3): half vectors come from the vertices.
//
// Model:  1 - n.h, h interpolated.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Space:  eye. Range: interpolated vectors of length 0 to 1.
// Edges:  as shadingDirection(); a light is asked for its direction before its half vector.
#include <normal>
#include <normal/versine>
#include "shading/light_number.glsl"

/// Prepares what all half vectors share: nothing.
void beginHalfways() {}

/// 1 - cos of the angle between the normal and the half vector of the light that was asked for last.
float versineOfHighlight(vec3 normal, vec3 toLight) {
    return highlightVersine(normal, shadingDirection(lightsHalfways[lightNumber]));
}
