layout(set = 0, binding = 2) uniform Values { float strength; vec4 tint; } values;
layout(set = 1, binding = 1) uniform sampler2D map;
OUTPUT(0) vec4 color;
void main() {
    color = values.strength * values.tint * texture(map, vec2(0.5)).a;
}
