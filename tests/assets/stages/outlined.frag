uniform sampler2D surface;
out vec4 color;

void main() {
    color = mix(vec4(1.0), texture(surface, corner.place), step(0.01, edge()));
}
