// Which sides of the surface are shaded, with which normal, material and radiance. Where the back is seen the normal is
// flipped; isBackVisible() tells.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading; OpenGL Programming Guide, 9th ed.,
//         ch. 7, Two-sided Lighting.

#piece one
// The normal is used as it is, whichever side is seen.
#include "surface/normal.glsl"

/// The unit normal to shade with; zero where there is none.
vec3 visibleNormal() { return surfaceNormal(); }

#piece two
#include "surface/normal.glsl"
#include "surface/side.glsl"

/// The unit normal to shade with, on the side that is seen; zero where there is none.
vec3 visibleNormal() {
    vec3 normal = surfaceNormal();  // a picture of it has derivatives, which a branch would leave undefined
    return isBackVisible() ? -normal : normal;
}

#piece two_materials
#include "sides/two.glsl"

#piece cosine
#include "surface/side.glsl"

/// The cosine to the normal of the side that is seen.
float cosineOfSide(float cosine) { return isBackVisible() ? -cosine : cosine; }

#piece cosine/one
/// The cosine as it is.
float cosineOfSide(float cosine) { return cosine; }

#piece material/one
// An index beyond the table takes the nearest row, never memory beside it.
/// The row of a table of so many materials, for a surface's index.
int materialRow(int index, int rows) { return clamp(index, 0, rows - 1); }

#piece material/two
#include "sides/material/one.glsl"

#piece material/two_materials
// A material for each side, from a table of pairs: 2 i in front, 2 i + 1 at the back.
#include "surface/side.glsl"

/// The row of a table of so many materials (an even number), for a surface's index.
int materialRow(int index, int rows) {
    int front = 2 * clamp(index, 0, rows / 2 - 1);
    return isBackVisible() ? front + 1 : front;
}

#piece radiance/one
// Computed at vertices. A rounding may make it negative: the caller clamps it.
/// The radiance interpolated between the vertices.
vec3 interpolatedRadiance() { return litRadiance; }

#piece radiance/two
// Computed at vertices for both sides: which side of a triangle is seen is not known there.
#include "surface/side.glsl"

/// The radiance interpolated between the vertices, of the side that is seen.
vec3 interpolatedRadiance() { return isBackVisible() ? backRadiance : litRadiance; }

#piece radiance/two_materials
#include "sides/radiance/two.glsl"

#piece flat_radiance/one
// Of the provoking vertex.
/// The radiance of the face's provoking vertex.
vec3 faceRadiance() { return flatRadiance; }

#piece flat_radiance/two
#include "surface/side.glsl"

/// The radiance of the face's provoking vertex, of the side that is seen.
vec3 faceRadiance() { return isBackVisible() ? flatBackRadiance : flatRadiance; }

#piece flat_radiance/two_materials
#include "sides/flat_radiance/two.glsl"
