BLOCK(0, Transform) { mat4 modelView; mat4 projection; } transform;
ATTRIBUTE(0) vec3 position;
void main() { gl_Position = transform.projection * (transform.modelView * vec4(position, 1.0)); }
