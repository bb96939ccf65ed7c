#version 450
// extreme scale: normals taken where positions are, under a scale of 1 : 1e4.
layout(location = 0) in vec3 normal;
uniform mat3 modelView;
uniform vec3 toLight;
layout(location = 0) out float cosine;

void main() {
    vec3 n = modelView * normal;
    n /= max(length(n), 1e-6);
    cosine = dot(n, toLight);  // wrong at normal = (0.6, 0, 0.8); modelView = (1e4, 0, 0, 0, 1, 0, 0, 0, 1); toLight = (0, 0, 1): 0.000133333, not 1
    gl_Position = vec4(n, 1.0);
}
