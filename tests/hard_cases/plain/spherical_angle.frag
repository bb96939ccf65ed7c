#version 450
// The angles of a direction along the pole.
layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 color;

void main() {
    float longitude = atan(direction.z, direction.x);  // trap: atan(0, 0)
    color = vec4(longitude);
}
