#version 450
// infinite radiance in fog: fog that hides everything, and behind it a colour that is infinite.
layout(location = 0) in vec3 radiance;
uniform float hidden;
layout(location = 0) out vec4 color;

void main() {
    color = vec4(mix(radiance, vec3(0.5), hidden), 1.0);  // wrong at radiance = (inf, inf, inf); hidden = 1: nan, not 0.5
}
