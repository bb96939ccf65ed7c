#version 450
// The root's operand is negative only inside a small ball around a point that nothing else singles out.
layout(location = 0) in vec3 surface;
layout(location = 0) out vec4 color;

void main() {
    vec3 away = surface - vec3(17.25, -41.5, 63.0);
    float excess = dot(away, away) - 1e-4;
    color = vec4(sqrt(excess));  // trap: sqrt() of a negative number
}
