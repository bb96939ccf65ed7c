#version 430 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in vec2 place[];
uniform sampler2D widths;
out Corner {
    vec2 place;
    vec3 distances;
} corner;

void main() {
    for (int i = 0; i < 3; ++i) {
        corner.place = place[i];
        corner.distances = vec3(0.0);
        corner.distances[i] = texture(widths, place[i]).r;
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
