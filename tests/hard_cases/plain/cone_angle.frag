#version 450
// behind a wide cone: the angle of a cosine that rounding has taken beyond 1.
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 0) out vec4 color;

void main() {
    float angle = acos(dot(a, b));  // trap: acos() of a number beyond [-1, 1]
    color = vec4(angle);
}
