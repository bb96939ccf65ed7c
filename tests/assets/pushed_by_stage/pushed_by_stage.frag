layout(push_constant) uniform Pushed { layout(offset = 16) vec4 tint; } pushed;
OUTPUT(0) vec4 color;
void main() {
    color = pushed.tint;
}
