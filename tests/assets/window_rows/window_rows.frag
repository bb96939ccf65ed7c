// What tells the upper edge of a window from its lower one.
VARYING(0) float height;
OUTPUT(0) vec4 color;
void main() {
    color = vec4(gl_FragCoord.y / 64.0, 0.5 + 0.02 * dFdy(height), 0.5 + 0.02 * dFdx(height), 1.0);
}
