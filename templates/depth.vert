// The vertex stage of the depth pass: places the vertex as the light sees it.
#include "surface/position.glsl"

void main() {
    placeVertex();
    gl_Position = transform.projection * vec4(surfacePosition(), 1.0);
}
