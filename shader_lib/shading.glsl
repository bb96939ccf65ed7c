// Where the lighting model is evaluated, and what that needs of the lights. Fog is always evaluated per fragment, since
// it depends on the fragment's distance.

#piece fragment.frag
// At each fragment: position and normal are interpolated.
// Source: Phong, Illumination for Computer Generated Pictures, CACM 18 (1975).
#include <lighting>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return litSurface(); }

#piece hybrid.frag
// At each fragment, but what changes slowly over a surface (the direction to each light, how much of it arrives, the half
// vector) at each vertex, interpolated.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
#include <lighting>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return litSurface(); }

#piece vertex.frag
// At each vertex, radiance interpolated. Source: Gouraud, Continuous Shading of Curved Surfaces, IEEE Transactions on
// Computers 20 (1971).
#include <sides/radiance>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return max(interpolatedRadiance(), vec3(0.0)); }  // guard: rounded out of its range

#piece flat.frag
// At each vertex: a face shows the radiance of its provoking vertex, the last one unless the application chooses another.
// Source: Bouknight, A Procedure for Generation of Three-Dimensional Half-Toned Computer Graphics Presentations, CACM 13
//         (1970).
#include <sides/flat_radiance>

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 surfaceRadiance() { return faceRadiance(); }

#piece light_ray
// Attenuation and weight 0 to 1e18. A direction of zero is a light from nowhere: it gives nothing.
/// The direction to the light, unit where the key has directions made so (zero: from nowhere); its attenuation,
/// by which its own ambient light is weakened; and the weight of its light that arrives, its cone counted in.
struct LightRay {
    vec3 toLight;
    float attenuation;
    LIGHT_PRECISION float weight;
};

#piece light_number
// Hybrid shading has a half vector for each light: directional lights first, then point lights, then spot lights. A light
// is asked for its ray before its half vector.
/// The number of the light that was asked for last.
int lightNumber;

#piece interpolated_ray.frag
#include <normal>
#include "shading/light_ray.glsl"

/// An interpolated ray, its direction as the key has normals. What the cone leaves is not told from attenuation.
LightRay interpolatedRay(vec4 ray) {
    float weight = max(ray.w, 0.0);  // guard: rounded out of its range
    return LightRay(shadingDirection(ray.xyz), weight, weight);
}
