// Light of a whole environment, as a cube map of what a white surface scatters of it (S14).
//
// Model:  A = mix(A_0, D(n), share), D the environment convolved with a cosine (docs/probes.md).
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Image-Based Lighting; Miller and Hoffman, Illumination and
//         Reflection Maps, SIGGRAPH 1984 course notes.
// Spaces: n in eye space, the map in its own axes. Ranges: A_0 and D 0 to 1e5 (radiance), share 0 to 1.
// Edges:  where there is no normal there is no direction to look in: A_0 alone (H-N1).
#include <sides>

/// A_0, the part that the map has in the mixture, and the rotation from eye space to the map's axes.
BLOCK(17, ImageLight) {
    vec3 color;
    float share;
    mat3 toMap;
} imageLight;

/// D: a white surface's radiance by the direction that it faces. One level.
SAMPLER(3, samplerCube) diffuseMap;

/// The ambient light that arrives at the surface.
vec3 ambientLight() {
    vec3 direction = imageLight.toMap * visibleNormal();
    if (direction == vec3(0.0)) return imageLight.color;  // H-N1
    return mix(imageLight.color, textureLod(diffuseMap, direction, 0.0).rgb, imageLight.share);
}
