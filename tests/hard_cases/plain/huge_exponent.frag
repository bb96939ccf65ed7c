#version 450
// huge numbers: numbers beyond all bounds.
layout(location = 0) in float intensity;
layout(location = 0) out vec4 color;

void main() {
    float bright = abs(intensity) * 1e30;
    color = vec4(bright * bright);  // trap: an infinity made from finite numbers
}
