#version 450
// too bright for the target: a bright colour on its way to a target of 16-bit floats.
layout(location = 0) in float brightness;
layout(location = 0) out vec4 color;

void main() {
    vec2 radiance = vec2(abs(brightness) * 1e4, 0.5);
    color = vec4(unpackHalf2x16(packHalf2x16(radiance)), 0.0, 1.0);  // trap: the output 'color' is infinite
}
