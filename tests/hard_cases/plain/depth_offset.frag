#version 450
// depth out of range: a depth moved by an offset.
layout(location = 0) in float offset;
layout(location = 0) out vec4 color;

void main() {
    color = vec4(1.0);
    gl_FragDepth = gl_FragCoord.z + offset;  // trap: the output 'gl_FragDepth' is negative; the output 'gl_FragDepth' is above what its inputs allow
}
