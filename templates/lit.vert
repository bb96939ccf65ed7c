// The vertex stage of every lit surface: places the vertex and writes what the fragment stage reads.
#include "surface/position.glsl"
#include <varyings>

void main() {
    placeVertex();
    gl_Position = transform.projection * vec4(surfacePosition(), 1.0);
    writeVaryings();
}
