// What a picture of normals holds. Source: glTF 2.0, 3.9.3.

#include <texture_placement>
#include "pbr/material.glsl"

/// Linear.
SAMPLER(8, sampler2D) normalMap;

/// 2 texel - 1, x and y scaled.
vec3 normalTexel() {
    vec3 texel = 2.0 * texture(normalMap, mapCoordinate(2)).xyz - 1.0;
    return vec3(material.normalScale * texel.xy, texel.z);
}
