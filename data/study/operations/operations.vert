// Places the vertex and hands on where it is.
#include "placement.glsl"
#include <varyings>

BLOCK(1, Transform) {
    mat4 modelViewProjection;
} transform;

void main() {
    gl_Position = transform.modelViewProjection * vec4(position, 1.0);
    writeVaryings();
}
