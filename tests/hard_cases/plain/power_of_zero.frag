#version 450
// zero to the power of zero: a highlight at the edge of the light, with shininess 0.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 halfway;
uniform float shininess;
layout(location = 0) out vec4 color;

void main() {
    float cosine = max(dot(normal, halfway), 0.0);
    color = vec4(pow(min(cosine, 1.0), clamp(shininess, 0.0, 8.0)));  // trap: pow(0, y) with y not above 0
}
