#version 450
// A sphere met by a ray, or missed.
layout(location = 0) in float b;
layout(location = 1) in float c;
layout(location = 0) out vec4 color;

void main() {
    float root = sqrt(b * b - c);  // trap: sqrt() of a negative number
    float scale = inversesqrt(abs(b));  // trap: inversesqrt() of a number not above 0
    float stops = log2(abs(c));  // trap: log2() of a number not above 0
    color = vec4(root, scale, stops, 1.0);
}
