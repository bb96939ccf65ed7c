#version 450
// tiny cone: a cone of 1e-4 radians by its angle: the cosine has no number there but 1.
layout(location = 0) in vec3 axis;
layout(location = 1) in vec3 ray;
uniform float cutoff;
layout(location = 0) out vec4 color;

void main() {
    float cosine = dot(axis, ray) / max(length(axis) * length(ray), 1e-3);
    float angle = acos(clamp(cosine, -1.0, 1.0));
    color = vec4(angle <= cutoff ? 1.0 : 0.0);  // inexact at axis = (0, 0, -1); ray = (0.0002, 0, -1); cutoff = 1e-4: 1, not 0
}
