#version 450
// What needs more than a pixel of its own: derivatives, discards, the side that is seen.
layout(location = 0) in vec3 eyePosition;
layout(location = 1) flat in vec3 faceNormal;
layout(location = 2) noperspective in vec2 screen;
layout(location = 0) out vec4 color;
void main() {
    if (fract(eyePosition.x * 2.0) < 0.2) discard;
    vec3 facet = normalize(cross(dFdx(eyePosition), dFdy(eyePosition)));
    color = vec4(facet * 0.1 + faceNormal, gl_FrontFacing ? screen.x : screen.y);
}
