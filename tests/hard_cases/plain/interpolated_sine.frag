#version 450
// interpolated out of range: a sine of an interpolated cosine, which left its range by a rounding.
layout(location = 0) in float cosine;
layout(location = 0) out vec4 color;

void main() {
    float sine = sqrt(1.0 - cosine * cosine);  // trap: sqrt() of a negative number
    color = vec4(sine);
}
