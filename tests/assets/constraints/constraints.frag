#version 450 core
struct Lamp { vec3 position; vec3 axis; float inner; float outer; };
layout(std140) uniform Fog { vec3 color; float near; vec3 tint; float far; float density; int steps; } fog;
layout(std140) uniform Lamps { vec4 center; float reach[2]; float least; Lamp lamps[3]; };

in vec3 toEye;
layout(location = 0) out vec4 color;

void main() {
    float sum = reach[0] + least + center.x;
    for (int i = 0; i < 3; ++i) sum += lamps[i].position.x + lamps[i].axis.x + lamps[i].inner + lamps[i].outer;
    color = vec4(toEye * fog.color + fog.tint * fog.density, sum * (fog.far - fog.near) + float(fog.steps));
}
