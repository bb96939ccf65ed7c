#ifdef CRASH
OUTPUT(0) vec4 abort_here;
void main() { abort_here = vec4(1.0); }
#else
OUTPUT(0) vec4 color;
void main() {
#ifdef RED
    color = vec4(1.0, 0.0, 0.0, 1.0);
#else
    color = vec4(1.0);
#endif
}
#endif
