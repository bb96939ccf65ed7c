#version 450
// hard-edged cone: a spot light whose inner cone is its outer cone.
layout(location = 0) in float cosine;
uniform float inner;
uniform float outer;
layout(location = 0) out vec4 color;

void main() {
    float low = min(inner, outer);
    float high = max(inner, outer);
    color = vec4(smoothstep(low, high, cosine));  // trap: smoothstep() with equal edges
}
