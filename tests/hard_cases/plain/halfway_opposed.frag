#version 450
// H-N4: Blinn's half vector, with a light exactly behind the viewer's ray.
layout(location = 0) in vec3 toLight;
layout(location = 1) in vec3 toViewer;
layout(location = 0) out vec4 color;

void main() {
    vec3 halfway = normalize(toLight + toViewer);  // trap: normalize() of a zero vector
    color = vec4(halfway, 1.0);
}
