// The environment as the surface mirrors it.

#piece none
/// The radiance of what is mirrored: none.
vec3 reflectionRadiance() { return vec3(0.0); }

#piece image
// A cube map blurred by the surface's shininess (docs/probes.md): weight strength K_s S(r) with r = 2 (n.v) n - v. Nothing
// is mirrored where there is no normal, nor at the viewer itself.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Image-Based Lighting; Miller and Hoffman, Illumination and Reflection
//         Maps, SIGGRAPH 1984 course notes.
#include <material>
#include <sides>
#include <viewer>

/// How much of the map is seen, and the rotation from eye space to its axes.
BLOCK(18, Reflection) {
    mat3 toMap;
    float weight;
} reflection;

/// S: what a surface of the material's shininess shows by the mirrored direction to the viewer. One level.
SAMPLER(4, samplerCube) specularMap;

/// The radiance of what is mirrored.
vec3 reflectionRadiance() {
    vec3 normal = visibleNormal();
    vec3 viewer = towardViewer();
    vec3 direction = reflection.toMap * reflect(-viewer, normal);
    bool isKnown = normal != vec3(0.0) && viewer != vec3(0.0) && direction != vec3(0.0);
    if (!isKnown) return vec3(0.0);  // guard: zero vector
    return (reflection.weight * material.strength) * material.specular * textureLod(specularMap, direction, 0.0).rgb;
}
