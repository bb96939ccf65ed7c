#version 450
// No colour is needed where the fragment is thrown away.
layout(location = 0) in vec2 coordinate;
uniform sampler2D mask;
layout(location = 0) out vec4 color;

void main() {
    vec4 texel = texture(mask, coordinate);
    if (texel.a < 0.5) discard;
    color = texel;
}
