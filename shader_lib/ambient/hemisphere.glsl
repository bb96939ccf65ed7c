// Light from a sky above and a ground below (S12).
//
// Model:  mix(G, S, a), with a the share of the sky that a surface facing n sees, as `hemisphere` has it.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Hemisphere Lighting; Baxley and Walker in Parent,
//         Advanced RenderMan, for the integral.
// Space:  eye. Ranges: up unit, S and G 0 to 1e5 (radiance).
// Edges:  a surface without a normal sees half of each (H-N1).
#include <hemisphere>
#include <sides>

/// The direction in which the sky lies (a unit vector in eye space), and the light of sky and ground.
BLOCK(20, Hemisphere) {
    vec3 up;
    vec3 sky;
    vec3 ground;
} hemisphere;

/// The ambient light that arrives at the surface.
vec3 ambientLight() { return mix(hemisphere.ground, hemisphere.sky, skyShare(visibleNormal(), hemisphere.up)); }
