#version 450
// zero to the power of zero: Schlick's power t / (m - m t + t), shininess and cosine 0.
layout(location = 0) in float cosine;
uniform float shininess;
layout(location = 0) out vec4 color;

void main() {
    float t = clamp(cosine, 0.0, 1.0);
    float m = abs(shininess);
    color = vec4(t / (m - m * t + t));  // trap: division by zero
}
