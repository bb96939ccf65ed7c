#version 430 core
in vec2 place;
uniform sampler2D surface;
out vec4 color;

void main() {
    color = texture(surface, place);
#ifdef STRIPED
    color *= step(0.5, fract(4.0 * place.x));
#endif
}
