#version 450
// infinite radiance in fog: an infinite colour behind fog that hides everything.
layout(location = 0) in float brightness;
layout(location = 0) out vec4 color;

void main() {
    float shaded = exp(abs(brightness) + 90.0);  // trap: an infinity made from finite numbers
    color = vec4(mix(shaded, 0.5, 1.0));
}
