// Each stage has a block and a sampler of its own, under one name and at two places.
ATTRIBUTE(0) vec3 position;
BLOCK(0, Transform) { mat4 modelViewProjection; } transform;
layout(set = 0, binding = 1) uniform Values { vec4 shift; } values;
layout(set = 1, binding = 0) uniform sampler2D map;
void main() {
    gl_Position = transform.modelViewProjection * (vec4(position, 1.0) + values.shift * textureLod(map, vec2(0.5), 0.0).a);
}
