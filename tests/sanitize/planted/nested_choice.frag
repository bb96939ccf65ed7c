#version 450
// Choices within choices; the last one divides by what a uniform leaves.
layout(location = 0) in vec2 place;
layout(binding = 0) uniform Settings {
    int mode;
    float near;
    float far;
} settings;
layout(location = 0) out vec4 color;

float depthOf(float z) {
    if (settings.mode == 7) {
        if (place.x > 99.99) {
            if (abs(place.y + settings.near) < 1e-4)
                return (z - settings.near) / (settings.far - settings.near - 0.5);  // trap: division by zero
        }
    }
    return z;
}

void main() { color = vec4(depthOf(place.x)); }
