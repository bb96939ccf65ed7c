// The environment that a metallic-roughness surface mirrors, with the ambient light that it scatters: what is mirrored is no longer
// there to be scattered.

#piece none
#include <ambient>
#include "pbr/surface.glsl"

/// The ambient light that the surface reflects.
vec3 environmentRadiance() { return surface.diffuse * ambientLight(); }

#piece image
// The split sum: w E S(r, roughness) + (1 - w E) c_d A, with E = A f0 + B f90 the environment BRDF, S the environment blurred by
// the distribution of normals, level by level of a cube map, r = 2 (n.v) n - v, w the weight; with `multiple_scattering` the light that
// leaves after several bounces besides.
// Source: Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course notes; glTF 2.0, appendix B.
// Edges:  without a normal, or at the viewer itself, nothing is mirrored.
#include <ambient>
#include <environment_brdf>
#include <multiple_scattering>
#include <reflection/mirrored>
#include "pbr/interface.glsl"
#include "pbr/surface.glsl"

/// The ambient light that the surface reflects, and what it mirrors.
vec3 environmentRadiance() {
    vec3 ambient = ambientLight();
    if (mirroredDirection(surface.normal) == vec3(0.0)) return surface.diffuse * ambient;  // guard: zero vector
    vec2 brdf = environmentBrdf(surface.nv, surface.roughness);
    vec3 once = mirroredPart(brdf.x * surface.f0 + brdf.y * surface.f90, surface.nv, brdf.x + brdf.y);
    vec3 again = reflection.weight * returnedToEnvironment(brdf, once);
    vec3 scattered = max(1.0 - reflection.weight * once - again, 0.0) * surface.diffuse;
    return once * mirroredRadiance(surface.normal, surface.roughness) + (again + scattered) * ambient;
}
