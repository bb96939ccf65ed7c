// Ambient light: what arrives at the surface from everything but its lights.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Ambient Light, Hemisphere Lighting, Lighting with Spherical
//         Harmonics, Image-Based Lighting.
// Ranges: eye space; directions unit, radiances 0 to 1e5.

#piece global
// The same from everywhere.
/// The global ambient light A.
BLOCK(2, Ambient) {
    vec3 color;
} ambient;

/// The ambient light that arrives at the surface.
vec3 ambientLight() { return ambient.color; }

#piece hemisphere
// A sky above and a ground below: mix(ground, sky, a), a being the part of the sky that the surface sees
// (hemisphere.glsl). A surface without a normal sees half of each.
#include <hemisphere>
#include <sides>

/// The direction in which the sky lies (a unit vector in eye space), and the light of sky and ground.
BLOCK(20, Hemisphere) {
    vec3 up;
    vec3 sky;
    vec3 ground;
} hemisphere;

/// The ambient light that arrives at the surface.
vec3 ambientLight() { return mix(hemisphere.ground, hemisphere.sky, skyWeight(visibleNormal(), hemisphere.up)); }

#piece spherical_harmonics
// A whole environment as nine coefficients: max(scale E(n), 0), E the irradiance polynomial (harmonics.glsl). A scale
// of 1 / pi makes it the radiance of a white surface. A small bright light makes the polynomial negative on its far
// side; what clamping adds to the energy, energy_added_by_clamping() of gobo/light_probes.hpp tells.
#include <harmonics>

/// The light that arrives at the surface.
vec3 ambientLight() { return max(harmonics.scale * irradiance(), vec3(0.0)); }  // guard: negative lobe

#piece image
// A whole environment as a cube map of the diffuse light of a white surface (docs/probes.md): mix(color, D(n), weight).
// Source: Miller and Hoffman, Illumination and Reflection Maps, SIGGRAPH 1984 course notes.
#include <sides>

/// A_0, the part that the map has in the mixture, and the rotation from eye space to the map's axes.
BLOCK(17, ImageLight) {
    vec3 color;
    float weight;
    mat3 toMap;
} imageLight;

/// D: a white surface's radiance by the direction that it faces. One level.
SAMPLER(3, samplerCube) diffuseMap;

/// The ambient light that arrives at the surface.
vec3 ambientLight() {
    vec3 direction = imageLight.toMap * visibleNormal();
    if (direction == vec3(0.0)) return imageLight.color;  // guard: zero vector
    return mix(imageLight.color, textureLod(diffuseMap, direction, 0.0).rgb, imageLight.weight);
}
