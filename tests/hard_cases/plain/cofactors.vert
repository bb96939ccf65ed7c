#version 450
// singular model matrix: normals by its inverse.
layout(location = 0) in vec3 normal;
uniform mat3 model;

void main() {
    vec3 eyeNormal = transpose(inverse(model)) * normal;  // trap: inverse() of a singular matrix
    gl_Position = vec4(eyeNormal, 1.0);
}
