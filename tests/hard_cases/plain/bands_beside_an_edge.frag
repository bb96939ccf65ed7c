#version 450
// edge between two tones: tones by floor, the cosine beside an edge of two: a rounding decides, as it does in ours.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 toLight;
uniform float levels;
layout(location = 0) out vec4 color;

void main() {
    float count = max(levels, 1.0);
    float cosine = dot(normal, toLight);
    color = vec4(floor(cosine * count) / count);  // inexact at normal = (0.7599342, 0, 0.65); toLight = (0, 0.9230769, 0.3846154); levels = 4: 0.25, not 0
}
