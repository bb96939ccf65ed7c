#version 450
// sharp highlight: a highlight of shininess 1e6, as the power of a cosine.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 toLight;
layout(location = 2) in vec3 toViewer;
uniform float shininess;
layout(location = 0) out vec4 color;

vec3 direction(vec3 v) {
    return v / max(length(v), 1e-3);
}

void main() {
    vec3 halfway = direction(direction(toLight) + direction(toViewer));
    float cosine = max(dot(direction(normal), halfway), 0.0);
    color = vec4(pow(cosine, max(shininess, 1.0)));  // inexact at normal = (0, 0.4, 1); toLight = (-0.0014, 0.4, 1.0012); toViewer = (0, 0.4, 1); shininess = 1e6: 0.887622, not 0.792845
}
