#version 450
// sum of many lights: 4096 of them, added up one after the other.
layout(location = 0) in float brightness;
layout(location = 0) out vec4 color;

void main() {
    float total = 0.0;
    for (int i = 0; i < 4096; ++i) total += brightness;
    color = vec4(total);  // inexact at brightness = 0.7: 2867.08, not 2867.2
}
