// Where a shadowed light's maps lie and how they are looked up (S15).
//
// Model:  M p and, of a point light, a + b / w.
// Spaces: `toMap` leads from eye space; `layer` is a layer of the maps, so that an application keeps one array
//         however few of its lights a draw counts.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Shadow Mapping.
// Ranges: entries of `toMap` within 1e6, layers 0 to 255, spread 1/4 to 1/2 (a face alone).
// Edges:  visibility() tells what w = 0 means (H-W1).

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
