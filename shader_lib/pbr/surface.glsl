// The surface point as its lights and its environment see it, found once.
//
// Source: glTF 2.0, appendix B.3; Burley, Physically Based Shading at Disney, SIGGRAPH 2012 course notes, for alpha.
// Edges:  alpha is at least 0.002, whose peak, 1 / (pi alpha^2) = 8e4, a float's directions still resolve; n.v is at least 1e-4,
//         since interpolated normals may face away from the viewer.

#include <emissive_map>
#include <metallic_roughness_map>
#include <sides>
#include <specular_antialiasing>
#include <viewer>
#include "pbr/base_color.glsl"

/// Unit vectors; n.v; roughness as it is perceived and the slope's width alpha; f0 of the whole surface and its
/// reflectance at grazing incidence; the diffuse colour.
struct Surface {
    vec3 normal;
    vec3 toViewer;
    float nv;
    float roughness;
    float alpha;
    vec3 base;
    float metallic;
    vec3 f0;
    float f90;
    vec3 diffuse;
};

/// Once beginSurface() has been called.
Surface surface;

/// Finds the surface point. To be called first.
void beginSurface() {
    surface.normal = visibleNormal();
    surface.toViewer = towardViewer();
    surface.nv = max(dot(surface.normal, surface.toViewer), 1e-4);  // guard: normal that faces away
    surface.base = baseColor().rgb;
    vec3 texel = metallicRoughnessTexel();
    surface.metallic = material.metallic * texel.b;
    surface.roughness = material.roughness * texel.g;
    float alpha = max(surface.roughness * surface.roughness, 0.002);  // guard: peak beyond what directions resolve
    surface.alpha = widenedAlpha(alpha);
    surface.f0 = mix(material.dielectric, surface.base, surface.metallic);
    surface.f90 = mix(material.dielectricEdge, 1.0, surface.metallic);
    surface.diffuse = (1.0 - surface.metallic) * surface.base;
}

/// The radiance that the surface emits.
vec3 emittedRadiance() { return material.emission * emissiveTexel(); }
