#version 450
// ringing harmonics: irradiance by second order, of one small light straight ahead, seen from 122 degrees.
layout(location = 0) in vec3 normal;
uniform vec3 coefficients;
layout(location = 0) out vec4 color;

void main() {
    float z = normal.z;
    color = vec4(0.886227 * coefficients.x + 1.023328 * coefficients.y * z +
                 coefficients.z * (0.743125 * z * z - 0.247708));  // wrong at normal = (0.8459, 0, -0.5333); coefficients = (0.282095, 0.488603, 0.630783): -0.0395835, not 0
}
