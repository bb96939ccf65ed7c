#version 450
// A texel's colour, stretched and taken to a power.
layout(location = 0) in vec2 coordinate;
uniform sampler2D picture;
layout(location = 0) out vec4 color;

void main() {
    float level = texture(picture, coordinate).r - 0.25;
    color = vec4(pow(level, 2.2));  // trap: pow() of a negative number
}
