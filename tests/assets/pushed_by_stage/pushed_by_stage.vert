// Each stage has push constants of its own, under one name and behind each other.
layout(push_constant) uniform Pushed { vec4 shift; } pushed;
ATTRIBUTE(0) vec3 position;
BLOCK(0, Transform) { mat4 modelViewProjection; } transform;
void main() {
    gl_Position = transform.modelViewProjection * (vec4(position, 1.0) + pushed.shift);
}
