#version 450
// broken depth promise: a depth that is promised to be greater, and is not.
layout(location = 0) in float offset;
layout(location = 0) out vec4 color;
layout(depth_greater) out float gl_FragDepth;

void main() {
    color = vec4(1.0);
    gl_FragDepth = clamp(gl_FragCoord.z + offset, 0.0, 1.0);  // trap: the output 'gl_FragDepth' breaks depth_greater
}
