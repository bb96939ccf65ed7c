#version 450
// large world: a light 0.3 from a point, both seen from afar of the world's origin.
layout(location = 0) in vec2 position;
uniform vec2 turn;
uniform vec2 origin;
uniform vec2 light;
layout(location = 0) out vec4 color;

void main() {
    vec2 seen = vec2(dot(turn, position), turn.x * position.y - turn.y * position.x) - origin;
    vec2 toLight = light - seen;
    color = vec4(1.0 / max(dot(toLight, toLight), 1e-2));  // inexact at position = (1000001.1875, 699998.375); turn = (0.8660254, 0.5); origin = (1216025.375, 106217.7734375); light = (0.5, -2.1): 13.491, not 12.0733
}
