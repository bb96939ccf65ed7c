// Where the pictures of a surface lie on it.

#piece plain
// All by the first texture coordinates.
#include "surface/texture_coordinate.glsl"

/// The texture coordinates of picture number `map`: base colour, metallic and roughness, normal, occlusion, emission.
vec2 mapCoordinate(int map) { return surfaceTextureCoordinate(); }

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
