ATTRIBUTE(0) vec3 position;
BLOCK(0, Transform) { mat4 modelViewProjection; } transform;
void main() {
#ifdef BY_ITSELF
    gl_Position = vec4(position.xy * 0.1 + vec2(0.2, 0.3), 0.5 + 0.1 * position.z, 1.0);
#else
    gl_Position = transform.modelViewProjection * vec4(position, 1.0);
#endif
#ifdef LIFTED
    gl_Position.y += 0.4 * gl_Position.w;
#endif
#ifdef FLATTENED
    gl_Position.z *= 0.5;
#endif
}
