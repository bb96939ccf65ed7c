#version 450
// light behind the viewer's ray: Blinn's half vector.
layout(location = 0) in vec3 toLight;
layout(location = 1) in vec3 toViewer;
layout(location = 0) out vec4 color;

void main() {
    vec3 halfway = normalize(toLight + toViewer);  // trap: normalize() of a zero vector
    color = vec4(halfway, 1.0);
}
