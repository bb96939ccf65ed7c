#version 450
// power of a negative base: the rim of a surface, 1 - |n.v| slightly below 0.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 toViewer;
layout(location = 0) out vec4 color;

void main() {
    float rim = 1.0 - abs(dot(normal, toViewer));
    color = vec4(pow(rim, 3.0));  // trap: pow() of a negative number
}
