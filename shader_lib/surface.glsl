// The surface at the vertex, from attributes and the object's transformations, and at the fragment, interpolated.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2; Phong, CACM 18 (1975); OpenGL 4.5, 14.6.1, for the side.
// Ranges: positions and entries of matrices within 1e6, colours 0 to 1, texture coordinates within 1e3.

#piece transform.vert
// normalMatrix is the inverse transpose of modelView's upper left 3x3, or any positive multiple of it (the cofactors where
// the model is singular): lengths do not matter.
/// The object's transformations: to eye space, from eye space to clip space, and of normals to eye space.
BLOCK(0, Transform) {
    mat4 modelView;
    mat4 projection;
    mat3 normalMatrix;
} transform;

#piece position.vert
#include "surface/transform.vert.glsl"

ATTRIBUTE(0) vec3 position;

/// The vertex in eye space, once placeVertex() has been called.
vec3 placedPosition;

/// Transforms the vertex to eye space, once. To be called first.
void placeVertex() { placedPosition = (transform.modelView * vec4(position, 1.0)).xyz; }

/// The position of the surface in eye space.
vec3 surfacePosition() { return placedPosition; }

#piece position.frag
/// The position of the surface in eye space.
vec3 surfacePosition() { return eyePosition; }

#piece normal.vert
// n = N x / |N x|, whatever the length. Without a normal: ambient and emission only.
#include <guards/unit_vector>
#include "surface/transform.vert.glsl"

ATTRIBUTE(1) vec3 normal;

/// The unit normal of the surface in eye space; zero where there is none.
vec3 surfaceNormal() { return unitVector(transform.normalMatrix * normal); }

#piece normal.frag
// Where interpolated normals cancel each other there is none.
#include <normal>

/// The normal of the surface in eye space, unit where the key has it made so; zero where there is none.
vec3 surfaceNormal() { return shadingDirection(eyeNormal); }

#piece color.vert
ATTRIBUTE(2) vec4 color;

/// The colour, linear, and its alpha, 0 to 1.
vec4 surfaceColor() { return color; }

#piece color.frag
/// The colour, linear, and its alpha, 0 to 1.
vec4 surfaceColor() { return max(vertexColor, vec4(0.0)); }  // guard: rounded out of its range

#piece texture_coordinate.vert
ATTRIBUTE(4) vec2 texcoord;

/// The texture coordinates, 1 for a whole texture.
vec2 surfaceTextureCoordinate() { return texcoord; }

#piece texture_coordinate.frag
/// The texture coordinates, 1 for a whole texture.
vec2 surfaceTextureCoordinate() { return textureCoordinate; }

#piece material_index.vert
ATTRIBUTE(3) int materialIndex;

/// The surface's index into a table of materials.
int surfaceMaterialIndex() { return materialIndex; }

#piece material_index.frag
// That of the provoking vertex.
/// The surface's index into a table of materials.
int surfaceMaterialIndex() { return flatMaterialIndex; }

#piece handedness.vert
// The sign of the determinant, since a mirrored model's triangles run the other way round; the view never mirrors. A model
// without volume counts as not mirrored.
#include "surface/transform.vert.glsl"

/// -1 where the model is mirrored, else 1.
float handednessOfModel() { return determinant(mat3(transform.modelView)) < 0.0 ? -1.0 : 1.0; }  // guard: mirrored model

#piece side.vert
// Both are shaded, one after the other: the fragment stage chooses.
/// Set to ask for the back's radiance.
bool backIsAsked = false;

/// Whether the surface's back is seen.
bool isBackVisible() { return backIsAsked; }

#piece side.frag
/// Whether the surface's back is seen.
bool isBackVisible() { return gl_FrontFacing != (handedness > 0.0); }  // guard: mirrored model
