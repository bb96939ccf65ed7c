// A metallic-roughness surface: emission + ambient light + the response to exactly the lights that the key counts. Linear,
// unclamped, not negative.
//
// Source: glTF 2.0, 3.9 and appendix B.

#include <clearcoat>
#include <directional>
#include <occlusion_map>
#include <point>
#include <reflection/split_sum>
#include <sheen>
#include <spot>
#include "pbr/surface.glsl"

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() {
    beginSurface();
    beginCoat();
    beginSheen();
    float occlusion = ambientOcclusion();
    vec3 ambient = underSheen(environmentRadiance()) + sheenEnvironment();
    vec3 radiance = underCoat(emittedRadiance() + occlusion * ambient) + occlusion * coatEnvironment();
#if DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS > 0
    beginResponse();
#endif
#if DIRECTIONAL_LIGHTS > 0
    addDirectionalLights();
#endif
#if POINT_LIGHTS > 0
    addPointLights();
#endif
#if SPOT_LIGHTS > 0
    addSpotLights();
#endif
#if DIRECTIONAL_LIGHTS + POINT_LIGHTS + SPOT_LIGHTS > 0
    radiance += responseRadiance();
#endif
    return radiance;
}
