// Shadows by maps: each shadowed light's view, as the depth of the nearest surface, drawn by the family `depth`. All maps
// are layers of one array, so that a stage has one sampler for any number of lights of any kind.
//
// Source: Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978; OpenGL Programming Guide, 9th ed., ch. 7,
//         Shadow Mapping; Everitt, Projective Texture Mapping (2001); Gerasimov, Omnidirectional Shadow Mapping, GPU
//         Gems (2004), ch. 12; OpenGL 4.5 core specification, 8.23 and table 8.19.
// Edges:  no shadow behind the light (w < 0), although its mirror image in the map may be one, nor beside, before or
//         behind what a map shows, nor at the light itself (w = 0).

#piece shadow
// `toMap` leads from eye space, entries within 1e6; `layer` 0 to 255, so that an application keeps one array however few
// of its lights a draw counts; `spread` 1/4 to 1/2: a little below 1/2 draws more than the face, so that the filter's
// texels lie on it and no seam shows.
/// Of a directional or spot light `toMap` gives, before the division by w, x, y and depth from 0 to 1; the
/// rest is unused. Of a point light it turns and moves to axes with the light at the origin, `layer` is that
/// of the face +x, those of -x +y -y +z -z follow; on a face, at a distance w along its axis, the depth is
/// depthScale + depthShift / w, and x and y are 1/2 + spread * (s, t) / w with s and t along the face's sides.
struct Shadow {
    mat4 toMap;
    float layer;
    float depthScale;
    float depthShift;
    float spread;
};

#piece parameters
#include "shadow/shadow.glsl"

/// Of the directional lights that cast shadows, then of such spot lights, then of such point lights.
BLOCK(16, Shadows) {
    Shadow shadows[DIRECTIONAL_SHADOWS + SPOT_SHADOWS + POINT_SHADOWS];
} shadows;

#piece maps
/// Compares `reference <= depth` (GL_COMPARE_REF_TO_TEXTURE, GL_LEQUAL). One level; wrapping does not matter.
SAMPLER(2, sampler2DArrayShadow) shadowMaps;

#piece comparison
// The level is given, so that lookups stand in branches and in vertex stages alike.
#include "shadow/maps.glsl"

/// How the maps' own filter answers for the place: xy where, z the depth that is compared.
float compareDepth(vec3 place, float layer) {
    return textureGrad(shadowMaps, vec4(place.xy, layer, place.z), vec2(0.0), vec2(0.0));
}

#piece map_size
#include "shadow/maps.glsl"

/// Texels along each side of the maps.
vec2 shadowMapSize() { return vec2(textureSize(shadowMaps, 0).xy); }

#piece visibility
// Only what lies within the map is divided by w, so no quotient leaves 0 to 1; nothing lies between 0 and a negative w.
#include <shadow_filter>

/// How much of the light reaches what projects to the place, before the division by w.
float visibility(vec4 projected, float layer) {
    float w = projected.w;
    bool isBeside = any(lessThan(projected.xyz, vec3(0.0))) || any(greaterThan(projected.xyz, vec3(w)));
    if (isBeside || w == 0.0) return 1.0;  // guard: behind the light, or beside its map
    return filteredVisibility(projected.xyz / w, layer);
}

#piece one_map
// A directional or spot light's. A matrix costs twelve multiplications; a varying for each map would take 4 of the 60
// components that are guaranteed, and make a vertex stage of its own for each number of shadows.
#include "shadow/shadow.glsl"
#include "shadow/visibility.glsl"
#include "surface/position.glsl"

/// How much of the light reaches the surface.
float mapVisibility(Shadow shadow) { return visibility(shadow.toMap * vec4(surfacePosition(), 1.0), shadow.layer); }

#piece six_maps
// A point light's: the face is chosen by the largest component of the ray from the light. A light is one matrix, not six.
#include "shadow/cube_face.glsl"
#include "shadow/shadow.glsl"
#include "shadow/visibility.glsl"
#include "surface/position.glsl"

/// How much of the light reaches the surface.
float cubeVisibility(Shadow shadow) {
    vec4 ray = cubeFace((shadow.toMap * vec4(surfacePosition(), 1.0)).xyz);
    vec2 place = 0.5 * ray.z + shadow.spread * ray.xy;
    float depth = shadow.depthScale * ray.z + shadow.depthShift;
    return visibility(vec4(place, depth, ray.z), shadow.layer + ray.w);
}

#piece cube_face
// Between faces the first of x, y, z, of two sides the negative one; the zero vector lies on the last face, its size 0.
/// s and t in xy, the size of the largest component in z: all to be divided by it; in w the face's number.
vec4 cubeFace(vec3 v) {
    vec3 size = abs(v);
    if (size.x >= size.y && size.x >= size.z && size.x > 0.0)
        return v.x > 0.0 ? vec4(-v.z, -v.y, v.x, 0.0) : vec4(v.z, -v.y, -v.x, 1.0);
    if (size.y >= size.z && size.y > 0.0)
        return v.y > 0.0 ? vec4(v.x, v.z, v.y, 2.0) : vec4(v.x, -v.z, -v.y, 3.0);
    return v.z > 0.0 ? vec4(v.x, -v.y, v.z, 4.0) : vec4(-v.x, -v.y, -v.z, 5.0);
}
