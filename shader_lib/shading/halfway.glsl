// The angle of Blinn's highlights.

// Computed where the model is evaluated.
#include <normal/halfway_one_minus_cosine>
#include <viewer>

/// The unit vector to the viewer.
vec3 halfwayViewer;

/// Prepares what all half vectors share. To be called before the first.
void beginHalfways() { halfwayViewer = towardViewer(); }

/// 1 - cos of the angle between the normal and the half vector of a light and the viewer.
float oneMinusCosineOfHighlight(vec3 normal, vec3 toLight) { return halfwayOneMinusCosine(normal, toLight, halfwayViewer); }

#piece hybrid.frag
// 1 - n.h, h interpolated between the vertices.
#include <normal>
#include <normal/one_minus_cosine>
#include "shading/light_number.glsl"

/// Prepares what all half vectors share: nothing.
void beginHalfways() {}

/// 1 - cos of the angle between the normal and the half vector of the light that was asked for last.
float oneMinusCosineOfHighlight(vec3 normal, vec3 toLight) {
    return highlightOneMinusCosine(normal, shadingDirection(lightsHalfways[lightNumber]));
}
