ATTRIBUTE(0) vec3 position;
BLOCK(0, Transform) { mat4 modelViewProjection; } transform;
VARYING(0) float height;
void main() {
    height = position.y;
    gl_Position = transform.modelViewProjection * vec4(position, 1.0);
}
