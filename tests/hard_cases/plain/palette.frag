#version 450
// A palette by a cosine: exactly 1 is beyond it, and below 0 as well.
layout(location = 0) in float cosine;
uniform vec4 palette[4];
layout(location = 0) out vec4 color;

void main() {
    int band = int(floor(clamp(cosine, -1.0, 1.0) * 4.0));
    color = palette[band];  // trap: array index out of bounds
}
