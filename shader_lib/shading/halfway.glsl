// The angle of Blinn's highlights, where light and viewer are known (S3).
//
// Model, source, range, edges: halfwayVersine().
#include <normal/halfway_versine>
#include <viewer>

/// The unit vector to the viewer.
vec3 halfwayViewer;

/// Prepares what all half vectors share. To be called before the first.
void beginHalfways() { halfwayViewer = towardViewer(); }

/// 1 - cos of the angle between the normal and the half vector of a light and the viewer.
float versineOfHighlight(vec3 normal, vec3 toLight) { return halfwayVersine(normal, toLight, halfwayViewer); }
