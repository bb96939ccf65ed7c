#version 450
// The bounds of a clamp come from outside, in any order.
layout(location = 0) in float value;
uniform float low;
uniform float high;
layout(location = 0) out vec4 color;

void main() {
    color = vec4(clamp(value, low, high));  // trap: clamp() with its minimum above its maximum
}
