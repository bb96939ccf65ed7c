// The angle between a normal that may be shorter than 1 and a half vector, as the plain dot product has it (S3).
//
// Model:  1 - n.h with h = (s + v) / |s + v|.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: the power's base is the dot product itself.
// Ranges: a normal of length 0 to 1, unit directions; result 0 to 2.
// Edges:  as highlightVersine(); a right angle for opposed directions (H-N4).
#include <guards/unit_vector>
#include <normal/versine>

/// 1 - n.h of the half vector of the directions to the light and the viewer.
float halfwayVersine(vec3 normal, vec3 toLight, vec3 toViewer) {
    return highlightVersine(normal, unitVector(toLight + toViewer));
}
