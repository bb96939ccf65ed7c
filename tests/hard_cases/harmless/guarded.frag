#version 450
// The same operations, each guarded.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform vec3 lightPosition;
uniform float shininess;
uniform float near;
uniform float far;
uniform vec4 palette[4];
layout(location = 0) out vec4 color;

vec3 direction(vec3 v) {
    float square = dot(v, v);
    return square > 0.0 ? v * inversesqrt(square) : vec3(0.0);
}

void main() {
    vec3 n = direction(normal);
    vec3 ray = lightPosition - position;
    float cosine = clamp(dot(n, direction(ray)), 0.0, 1.0);
    float highlight = cosine > 0.0 ? pow(cosine, clamp(shininess, 1.0, 100.0)) : 0.0;
    float fade = 1.0 / (1.0 + dot(ray, ray));
    float depth = far - near;
    float fogFactor = abs(depth) > 1e-3 ? clamp((far + position.z) / depth, 0.0, 1.0) : 1.0;
    float angle = acos(cosine);
    int band = min(int(cosine * 4.0), 3);
    color = palette[band] * fade * fogFactor + highlight * angle;
}
