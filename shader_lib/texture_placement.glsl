// Where the pictures of a surface lie on it.

#piece plain
// All by the first texture coordinates.
#include "surface/texture_coordinate.glsl"

/// The texture coordinates of picture number `map`: base colour, metallic and roughness, normal, occlusion, emission.
vec2 mapCoordinate(int map) { return surfaceTextureCoordinate(); }

#piece steps/plain
/// The change of those coordinates from pixel to pixel, in +x (xy) and in +y (zw).
vec4 mapSteps(int map) { return vec4(dFdx(textureCoordinate), dFdy(textureCoordinate)); }

#piece placed
// Each by its own set of texture coordinates, turned, stretched and moved. Source: glTF 2.0, KHR_texture_transform.
#include "surface/texture_coordinate.glsl"
#include "surface/texture_coordinate1.glsl"

/// `linear` holds a, b, c, d of (a u + b v, c u + d v), to which `offset` is added; `set` is 0 or 1.
struct TexturePlacement {
    vec4 linear;
    vec2 offset;
    int set;
};

/// Of the pictures of base colour, metallic and roughness, normal, occlusion, emission.
BLOCK(11, TexturePlacements) {
    TexturePlacement maps[5];
} texturePlacements;

/// The texture coordinates of picture number `map`: base colour, metallic and roughness, normal, occlusion, emission.
vec2 mapCoordinate(int map) {
    vec2 uv = texturePlacements.maps[map].set == 0 ? surfaceTextureCoordinate() : surfaceTextureCoordinate1();
    vec4 linear = texturePlacements.maps[map].linear;
    return vec2(dot(linear.xy, uv), dot(linear.zw, uv)) + texturePlacements.maps[map].offset;
}

#piece steps/placed
#include "texture_placement/placed.glsl"

/// The change of those coordinates from pixel to pixel, in +x (xy) and in +y (zw).
vec4 mapSteps(int map) {
    vec4 first = vec4(dFdx(textureCoordinate), dFdy(textureCoordinate));
    vec4 second = vec4(dFdx(textureCoordinate1), dFdy(textureCoordinate1));
    vec4 uv = texturePlacements.maps[map].set == 0 ? first : second;
    vec4 linear = texturePlacements.maps[map].linear;
    return vec4(dot(linear.xy, uv.xy), dot(linear.zw, uv.xy), dot(linear.xy, uv.zw), dot(linear.zw, uv.zw));
}
