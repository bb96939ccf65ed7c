#version 450
// A branch that needs two numbers in narrow bands, and in it a divisor that is 0 at one number only.
layout(location = 0) in vec3 surface;
layout(location = 1) in float exposure;
layout(location = 2) in float scale;
layout(location = 3) in float level;
layout(location = 0) out vec4 color;

void main() {
    float gain = 1.0;
    if (surface.x > 12.34 && surface.x < 12.3401) {
        if (exposure * scale > 4000.0 && exposure * scale < 4000.01)
            gain = 1.0 / (level - 33.28125);  // trap: division by zero
    }
    color = vec4(gain * surface, 1.0);
}
