// Where a fragment is in the window.
OUTPUT(0) vec4 color;
void main() {
    color = vec4(gl_FragCoord.xyz / vec3(64.0, 64.0, 1.0), gl_FrontFacing ? 1.0 : 0.5);
}
