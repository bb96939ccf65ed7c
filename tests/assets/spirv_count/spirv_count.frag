OUTPUT(0) vec4 color;
void main() { color = vec4(float(LAMPS), 1.0, 0.0, 1.0); }
