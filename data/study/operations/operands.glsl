// What operations work on besides their own result: unknown when the shader is compiled, so that nothing is folded.

BLOCK(0, Operands) {
    mat4 turn;
    vec4 increment;  // near 0.1
    vec4 factor;     // near 1
    ivec4 bits;
} operands;
